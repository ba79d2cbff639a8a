// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "share_inputs.h"

#include <algorithm>
#include <map>
#include <new>
#include <utility>

#include "commands/shared/messages.h"
#include "commands/shared/output_claims.h"
#include "commands/shared/values.h"
#include "copy_points.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/segmentation/cluster_share.h"
#include "shifted_points.h"
#include "tiled_labels.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;

std::string path_of(const Job& job) {
  if (is_synth(job.input)) return job.input;
  const std::string file = job.recording ? job.input.substr(0, job.input.rfind('#')) : job.input;
  return fs::absolute(file).string();
}

}  // namespace

ObjectInputs inputs_of_share(const Tiles& tiles, const PointRange& range, const Options& options) {
  ObjectInputs inputs{{}, options.bin_fields, options.columns, options.topic};
  std::size_t number = 0;  // among those that are not excluded
  for (std::size_t i = 0; i < tiles.jobs().size(); ++i) {
    if (tiles.header(i).error) continue;
    const auto [first, end] = tiles.points_of(i);
    if (first <= range.second && end >= range.first) {  // also those without points
      const Job& job = tiles.jobs()[i];
      inputs.list.push_back({number, end - first, path_of(job)});
      if (job.recording) inputs.list.back().recorded = job.number;
    }
    ++number;
  }
  return inputs;
}

namespace {

// An input of a share, and how it is read.
struct NamedInput {
  const ObjectInput* input;
  const ObjectInputs* among;
};

// For each cloud, its inputs by their numbers.
std::vector<std::map<std::size_t, NamedInput>> named_inputs(const OpenShares& open) {
  const std::vector<PartialFile>& clouds = open.clouds.clouds();
  std::vector<std::map<std::size_t, NamedInput>> named(clouds.size());
  for (std::size_t s = 0; s < open.shares.size(); ++s) {
    const ObjectFileHeader& header = open.shares[s]->header();
    if (!header.inputs)
      throw IoError(open.names[s] +
                    ": was written by an older version, without the paths of its inputs: make it again to "
                    "use --labels");
    const auto cloud = std::find_if(clouds.begin(), clouds.end(), [&](const PartialFile& other) {
      return other.has_inputs_of(header.cloud);
    });
    for (const ObjectInput& input : header.inputs->list)
      named[static_cast<std::size_t>(cloud - clouds.begin())].try_emplace(
          input.number, NamedInput{&input, &*header.inputs});
  }
  return named;
}

// Throws if these are not the inputs of the cloud.
void require_inputs(const std::map<std::size_t, NamedInput>& named, const PartialFile& cloud) {
  PartialFile found;
  for (const auto& [number, each] : named)
    found.add_input(fs::path(each.input->path).filename().string() +
                        (each.input->recorded ? '#' + std::to_string(*each.input->recorded) : std::string()),
                    each.input->points);
  if (found.inputs != cloud.inputs || found.inputs_hash != cloud.inputs_hash ||
      found.cloud_points != cloud.cloud_points)
    throw IoError("the paths in the shares do not match their cloud: make the shares again");
}

// Opens each recording once.
class JobMaker {
 public:
  Job make(const NamedInput& named) {
    const ObjectInput& input = *named.input;
    Job job{input.path};
    if (input.recorded) job = recorded(input, named.among->topic);
    job.bin_fields = named.among->bin_fields;
    job.columns = named.among->columns;
    return job;
  }

 private:
  Job recorded(const ObjectInput& input, const std::string& topic) {
    auto [found, is_new] = recordings_.try_emplace({input.path, topic});
    if (is_new) found->second = list(input.path, topic);
    const std::size_t number = *input.recorded;
    if (number < found->second.size() && found->second[number].recording) return found->second[number];
    const std::string name = input.path + '#' + std::to_string(number);
    return {name,
            found->second.empty() ? kChangedWhileRead : found->second.front().error.value_or("is not there")};
  }

  static std::vector<Job> list(const std::string& path, const std::string& topic) {
    Options options;
    options.inputs = {path};
    options.topic = topic;
    try {
      return list_inputs(options);
    } catch (const UsageError& error) {
      return {{path, error.what()}};
    }
  }

  std::map<std::pair<std::string, std::string>, std::vector<Job>> recordings_;  // by path and topic
};

void claim_files(const OpenShares& open, const std::vector<LabelledInput>& inputs, const Options& options) {
  OutputClaims claims;
  for (const std::string& name : open.names)
    claims.add_input(name);
  for (const LabelledInput& input : inputs)
    if (!is_synth(input.job.input) && !input.job.recording) claims.add_input(input.job.input);
  for (const auto* output : {&options.output, &options.mesh})
    if (*output) claims.claim(**output);
  if (options.objects) claims.claim_folder(*options.objects);
  for (const LabelledInput& input : inputs)
    claims.claim(input.file);
}

}  // namespace

std::vector<LabelledInput> inputs_to_label(const OpenShares& open, const Options& options) {
  const std::vector<PartialFile>& clouds = open.clouds.clouds();
  const auto named = named_inputs(open);
  std::vector<LabelledInput> inputs;
  JobMaker jobs;
  std::size_t first = 0;
  for (std::size_t c = 0; c < clouds.size(); ++c) {
    require_inputs(named[c], clouds[c]);
    for (const auto& [number, each] : named[c]) {
      LabelledInput& added = inputs.emplace_back();
      added.job = jobs.make(each);
      added.points = {first, first + each.input->points};
      added.file = label_file(*options.labels, added.job.input);
      first = added.points.second;
    }
  }
  claim_files(open, inputs, options);
  return inputs;
}

namespace {

// Throws IoError if points are others than those that have the check sums.
void require_points(PointView points, const std::optional<Eigen::Vector3d>& origin, ScalarType scalar,
                    const std::vector<std::uint32_t>& sums) {
  const bool same_count = points.count == sums.size();
  if (!same_count || (scalar == ScalarType::float32 && points.scalar != scalar))
    throw IoError("has changed since the shares were made");
  std::optional<ShiftedPoints> shifted;
  if (origin) {
    shifted.emplace(points, *origin);
    points = view_of(*shifted, points.count, ScalarType::float64);
  }
  std::vector<std::byte> bytes(3 * size_of(scalar) * kChunkPoints);
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
    const LoadedPoints part = load_chunk(points, chunk);
    copy_points(part.view(), scalar, bytes.data());
    for (std::size_t i = 0; i < part.view().count; ++i) {
      const std::uint32_t sum = sums[chunk * kChunkPoints + i];
      if (sum != 0 && sum != point_check_sum(&bytes[3 * size_of(scalar) * i], scalar))
        throw IoError("has changed since the shares were made");
    }
  }
}

// Sets the labels of points of the ground, the first of which has the number `first` among all clouds.
void label_ground(const OpenShares& open, std::size_t first, std::vector<std::uint32_t>& labels) {
  std::vector<std::uint8_t> ground;
  for (std::size_t s = 0; s < open.shares.size(); ++s) {
    const ObjectFile& share = *open.shares[s];
    const ObjectFileHeader& header = share.header();
    const std::size_t last = share.first_number + header.cloud.cloud_points;  // of the cloud
    if (!header.ground || first < share.first_number || first >= last) continue;
    ground.resize(labels.size());
    try {
      share.mark_ground(first - share.first_number, ground);
    } catch (const IoError& error) {
      throw IoError(open.names[s] + ": " + error.what());
    }
  }
  for (std::size_t i = 0; i < ground.size(); ++i)
    if (ground[i] != 0) labels[i] = kLabelGround;
}

void write_labels_of(const LabelledInput& input, const OpenShares& open,
                     const std::optional<Eigen::Vector3d>& origin, ScalarType scalar,
                     const ObjectList& list) {
  RawCloud cloud = load_cloud(input.job, {Serial{}, Isa::scalar});
  const std::size_t first = input.points.first, count = input.points.second - first;
  if (cloud.size() != count) throw IoError("has changed since the shares were made");
  require_points(cloud.xyz(), origin, scalar, list.check_sums(first, count));
  std::vector<std::uint32_t> labels = list.labels(first, count);
  label_ground(open, first, labels);
  try {
    write_labelled(input.file, std::move(cloud), labels);
  } catch (const IoError& error) {
    throw IoError(input.file.string() + ": " + error.what());
  }
}

}  // namespace

Status write_input_labels(const std::vector<LabelledInput>& inputs, const OpenShares& open,
                          const std::optional<Eigen::Vector3d>& origin, ScalarType scalar,
                          const ObjectList& list) {
  Status status = Status::done;
  for (const LabelledInput& input : inputs) {
    try {
      write_labels_of(input, open, origin, scalar, list);
    } catch (const std::exception& error) {
      report_problem(input.job.input + ": " + reason_of(error));
      status = Status::failed;
    }
  }
  return status;
}

}  // namespace pcl_bv::detail
