// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Turns the arguments into jobs.

#include "inputs.h"

#include <algorithm>

#include "commands/shared/messages.h"
#include "commands/shared/output_claims.h"
#include "commands/shared/values.h"
#include "pcl_bv/io/list_clouds.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/io/text_cloud.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/report/meshes.h"
#include "pcl_bv/synth/synth.h"
#include "stream/sources/sources.h"
#include "tiles.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view synth_prefix = "synth:";

bool is_folder(const std::string& path) {
  std::error_code unknown;
  return !is_synth(path) && fs::is_directory(path, unknown);
}

void report_new_warnings(RecordedClouds& clouds, const std::string& file) {
  for (const std::string& warning : clouds.take_warnings())
    report_problem(std::string(file).append(": ").append(warning));
}

// Loads a recorded cloud. Reports damage of the file afterwards, because much of it is found only while
// clouds are read.
RawCloud load_recorded(const Job& job) {
  const std::string file = job.input.substr(0, job.input.rfind('#'));
  try {
    RawCloud cloud = job.recording->load(job.number);
    report_new_warnings(*job.recording, file);
    return cloud;
  } catch (const std::exception&) {
    report_new_warnings(*job.recording, file);
    throw;
  }
}

std::vector<Job> expand_recording(const std::string& argument, const std::string& topic) {
  const auto clouds = std::make_shared<RecordedClouds>(argument, topic);
  const std::size_t count = clouds->count();
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < count; ++i) {
    Job& job = jobs.emplace_back();
    job.input = argument;
    job.input.append("#").append(std::to_string(i));
    job.recording = clouds;
    job.number = i;
  }
  report_new_warnings(*clouds, argument);
  if (jobs.empty()) return {{argument, "no cloud in this recording"}};
  return jobs;
}

std::vector<Job> expand(const std::string& argument, const std::string& topic) {
  try {
    if (!is_synth(argument) && has_recorded_clouds(argument)) return expand_recording(argument, topic);
    if (!is_synth(argument)) check_recording_content(argument);
  } catch (const IoError& error) {
    return {{argument, error.what()}};
  } catch (const std::invalid_argument& error) {
    throw UsageError(argument + ": " + error.what());
  }
  if (!is_folder(argument)) return {{argument}};
  try {
    std::vector<Job> jobs;
    std::size_t subfolders = 0;
    for (const fs::path& path : list_clouds(argument, &subfolders))
      jobs.push_back({path.string()});
    warn_of_subfolders(argument, subfolders);
    if (!jobs.empty()) return jobs;
    return {{argument, "no .pcd, .ply, .las, .laz or .bin file in this folder"}};
  } catch (const IoError& error) {
    return {{argument, error.what()}};
  }
}

}  // namespace

std::vector<Job> list_partials(const std::string& argument) {
  if (!is_folder(argument)) return {{argument}};
  std::vector<Job> jobs;
  std::error_code unreadable;
  for (const fs::directory_entry& entry : fs::directory_iterator(argument, unreadable)) {
    if (entry.path().filename().string().front() != '.' && !entry.is_directory())
      jobs.push_back({entry.path().string()});
  }
  std::sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.input < b.input; });
  if (jobs.empty()) return {{argument, "no file of partial results in this folder"}};
  return jobs;
}

namespace {

// Makes one job of all inputs.
Job merged_job(const Options& options, std::vector<Job> inputs, std::shared_ptr<Tiles> tiles) {
  Job job;
  job.input = kTiledName;
  if (tiles) {
    job.tiles = std::move(tiles);
  } else if (options.merge) {
    for (const Job& input : inputs) {
      if (input.error) throw IoError(input.input + ": " + *input.error);
      job.partials.push_back(input.input);
    }
  } else {
    job.tiles = open_tiles(std::move(inputs), options.pipeline.execution().parallel);
  }
  return job;
}

std::string stem(const std::string& input) {
  const std::size_t number = input.rfind('#');  // a recorded cloud: FILE.mcap#3 becomes FILE-3
  if (!is_synth(input) && number != std::string::npos &&
      input.find_first_not_of("0123456789", number + 1) == std::string::npos)
    return fs::path(input.substr(0, number)).stem().string() + '-' + input.substr(number + 1);
  if (!is_synth(input)) return fs::path(input).stem().string();
  std::string name = input.substr(synth_prefix.size());
  std::replace(name.begin(), name.end(), ':', '-');
  return name;
}

// Throws UsageError for options that have no effect on any of the inputs. An input that cannot be
// read is treated as an input of every kind, because its own error follows.
void reject_useless_for_inputs(const Options& options, const std::vector<Job>& jobs) {
  if (jobs.empty()) return;
  const auto any = [&](const auto& matches) {
    return std::any_of(jobs.begin(), jobs.end(), [&](const Job& job) {
      std::error_code unknown;
      const bool cloud_file = !job.recording && !is_synth(job.input);
      return job.error || matches(job) || (cloud_file && !fs::exists(job.input, unknown));
    });
  };
  const auto is_bin = [](const Job& job) {
    return !job.recording && lower_case_extension(job.input) == ".bin";
  };
  const auto is_text = [](const Job& job) { return !job.recording && is_text_name(job.input); };
  const auto is_recorded = [](const Job& job) { return job.recording != nullptr; };
  reject_useless(
      {{"--bin-fields", options.bin_fields > 0, any(is_bin), ".bin files"},
       {"--columns", !options.columns.empty(), any(is_text), "text files: .xyz, .csv, .txt, .asc or .pts"},
       {"--topic", !options.topic.empty(), any(is_recorded), "a recording"}});
}

}  // namespace

bool is_synth(const std::string& input) {
  return input.starts_with(synth_prefix);
}

std::vector<Job> list_inputs(const Options& options) {
  std::vector<Job> jobs;
  for (const std::string& argument : options.inputs) {
    for (Job& job : options.merge ? list_partials(argument) : expand(argument, options.topic)) {
      job.bin_fields = options.bin_fields;
      job.columns = options.columns;
      jobs.push_back(std::move(job));
    }
  }
  reject_useless_for_inputs(options, jobs);
  return jobs;
}

fs::path label_file(const fs::path& folder, const std::string& input) {
  return folder / (stem(input) + ".pcd");
}

std::shared_ptr<Tiles> open_tiles(std::vector<Job> inputs, const ParallelPolicy& policy) {
  std::vector<TileHeader> headers(inputs.size());
  for_each_chunk(policy, inputs.size(), [&](std::size_t i) { headers[i] = describe_tile(inputs[i]); });
  return std::make_shared<Tiles>(std::move(inputs), std::move(headers), thread_count(policy));
}

namespace {

// Plans a file in the folder for each input of a tiled cloud. Those of merged shares are not known yet.
void claim_tile_labels(const Options& options, Job& job, OutputClaims& claims) {
  const fs::path& folder = *options.labels;
  const std::string needs = options.merge ? "--merge needs" : "--together needs";
  if (folder.has_extension() && !is_folder(folder.string()))
    reject_value("--labels", folder.string(), "is no folder, which " + needs);
  if (!job.tiles) return;
  for (const Job& tile : job.tiles->jobs()) {
    job.tile_labels.push_back(label_file(folder, tile.input));
    if (!tile.error) claims.claim(job.tile_labels.back());
  }
}

}  // namespace

std::vector<Job> plan_jobs(const Options& options, std::vector<Job> inputs, std::shared_ptr<Tiles> tiles) {
  const bool one = options.tiled || options.merge;
  const bool several = !one && (inputs.size() > 1 || is_folder(options.inputs.front()));
  const auto target = [&](const char* option, const fs::path& given, Job& job, const char* extension) {
    reject_dash(given);
    if (several || !given.has_filename() || is_folder(given.string())) {
      const fs::path file = given / (stem(job.input) + extension);
      job.folders.insert(file.parent_path());
      return file;
    }
    if (given.has_extension() || needs_no_suffix(given)) return given;
    reject_value(option, given.string(), std::string("has no suffix such as ") + extension);
  };
  // The extension of the output selects the format, also if the output is a folder.
  const bool svg = options.image && lower_case_extension(*options.image) == ".svg";
  const char* image_extension = svg ? ".svg" : ".png";
  const MeshFormat mesh =
      options.mesh ? mesh_format(*options.mesh).value_or(MeshFormat::ply) : MeshFormat::ply;
  const char* mesh_extension = mesh == MeshFormat::vtp ? ".vtp" : mesh == MeshFormat::glb ? ".glb" : ".ply";
  OutputClaims claims;
  for (const std::string& argument : options.inputs) {
    if (!is_synth(argument)) claims.add_input(argument);
  }
  if (!options.config_file.empty()) claims.add_input(options.config_file);
  for (const RegionConfig& region : options.pipeline.filter.regions)
    claims.add_input(region.file);
  for (const Job& job : inputs) {
    if (!is_synth(job.input) && !job.recording) claims.add_input(job.input);
  }
  if (options.ground_parts) {
    for (const Job& part : list_partials(options.ground_parts->string()))
      claims.add_input(part.input);
  }
  if (options.partial) claims.claim(*options.partial);
  std::vector<Job> jobs =
      one ? std::vector{merged_job(options, std::move(inputs), std::move(tiles))} : std::move(inputs);
  if (options.output) claims.claim(*options.output);
  if (jobs.size() > 1 && has_one_input(options.format))
    throw UsageError("--format: files of kitti, sustech and 3D Tiles have one input, not " +
                     std::to_string(jobs.size()));
  for (Job& job : jobs) {
    if (jobs.size() > 1) job.frame = static_cast<std::size_t>(&job - jobs.data());
    if (job.error) continue;
    if (options.labels && one) {
      claim_tile_labels(options, job, claims);
    } else if (options.labels)
      claims.claim(job.labels.emplace(target("--labels", *options.labels, job, ".pcd")));
    if (options.mesh) claims.claim(job.mesh.emplace(target("--mesh", *options.mesh, job, mesh_extension)));
    if (options.image)
      claims.claim(job.image.emplace(target("--image", *options.image, job, image_extension)));
    if (options.view_html)
      claims.claim(job.view_html.emplace(target("--view-html", *options.view_html, job, ".html")));
    if (options.objects) {
      claims.claim_folder(
          job.objects.emplace(several ? *options.objects / stem(job.input) : *options.objects));
      if (several) job.folders.insert(job.objects->parent_path());
    }
  }
  return jobs;
}

RawCloud load_cloud(const Job& job, const Execution& execution, const BoxPredicate& can_skip) {
  if (job.error) throw IoError(*job.error);
  if (is_synth(job.input)) {
    const std::string_view scene = std::string_view(job.input).substr(synth_prefix.size());
    return to_raw_cloud(make_synth(parse_synth(scene)));
  }
  if (job.recording) return load_recorded(job);
  if (can_skip) return read_las(job.input, execution, can_skip);
  return read_cloud(job.input, {job.bin_fields, job.columns}, execution);
}

}  // namespace pcl_bv::detail
