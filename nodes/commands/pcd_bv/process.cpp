// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Processes one input, from the file to the report.

#include "process.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <type_traits>
#include <utility>

#include "commands/shared/messages.h"
#include "commands/shared/setting_options.h"
#include "commands/shared/values.h"
#include "loaded_cloud.h"
#include "object_files.h"
#include "object_shares.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/report/meshes.h"
#include "pcl_bv/report/picture.h"
#include "pcl_bv/segmentation/up.h"
#include "shares.h"
#include "shifted_points.h"
#include "skip_predicate.h"
#include "stopwatch.h"
#include "tile_progress.h"
#include "tiled_objects.h"
#include "view_html.h"

namespace pcl_bv {
using namespace detail;
namespace {

/// If requested, counts the points outside of each volume whose fit has not failed.
void check(const PointView& cloud, const FrameResult& result, const Options& options,
           std::vector<std::size_t>& outside) {
  if (!options.check) return;
  const std::size_t methods = result.methods.size();
  outside.assign(result.volumes.size(), 0);
  for (std::size_t i = 0; i < outside.size(); ++i) {
    if (!result.is_requested(i / methods, i % methods) || !result.results[i].reason.empty()) continue;
    outside[i] =
        verify(result.volumes[i], result.points_of(i / methods, cloud), execution_of(options)).outside;
  }
}

/// Runs `write`, which creates `path`, a file or the folder of files. Before, creates the folder of `path` if
/// an option names that folder. Reports errors. Returns what `write` returns, if anything.
template <typename Write>
Status write_file(const Job& job, const std::filesystem::path& path, const Write& write) {
  try {
    if (job.folders.count(path.parent_path()) > 0) create_folder(path.parent_path());
    if constexpr (std::is_same_v<decltype(write()), Status>) {
      return write();
    } else {
      write();
      return Status::done;
    }
  } catch (const std::exception& error) {
    report_problem(path.string() + ": " + reason_of(error));
  }
  return Status::failed;
}

/// Writes the requested files other than the report. The file of labels is the loaded cloud with an added
/// field.
Status write_files(const Job& job, const Options& options, const Frame& frame, const Outcome& outcome,
                   LoadedCloud& loaded) {
  const FrameResult& result = *outcome.result;
  std::vector<std::uint32_t> label;
  const bool glb = job.mesh && mesh_format(*job.mesh) == MeshFormat::glb;
  const bool shows_ground = (job.view_html || glb) && result.ground.found;
  const bool shows_labels = (job.image || job.view_html || glb) && (options.clusters() || shows_ground);
  if (job.labels || shows_labels) label = labels_of(frame, result);
  Status status = Status::done;
  if (job.mesh)
    status = write_mesh(job, outcome.entries(), {loaded.xyz(), label, 200000, options.pipeline.ground.up});
  if (job.objects) {
    const auto write = [&](std::size_t id) {
      write_object(*job.objects, id, result.points_of(id, loaded.xyz()));
    };
    status = worse(status, write_file(job, *job.objects, [&] {
                     return write_objects(*job.objects, result.clusters.size(),
                                          execution_of(options).parallel, write);
                   }));
  }
  if (job.image) {
    status = worse(status, write_file(job, *job.image, [&] {
                     Picture picture = picture_of(frame, result, label);
                     picture.from = options.view;
                     write_picture(*job.image, picture);
                   }));
  }
  if (job.view_html) {
    status = worse(status, write_file(job, *job.view_html, [&] {
                     Report report = outcome.report;
                     report.clusters = outcome.entries();
                     write_file_atomically(*job.view_html, view_html(frame, result, report, label));
                   }));
  }
  if (job.labels) {
    status = worse(status, write_file(job, *job.labels, [&] {
                     RawCloud cloud = loaded.take();
                     set_uint32_field(cloud, "label", label);
                     write_pcd(*job.labels, cloud);
                   }));
  }
  return status;
}

/// Returns the warnings that a user should read before trusting the results.
std::vector<std::string> result_warnings(const Frame& frame, const FrameResult& result,
                                         const std::optional<Eigen::Vector3d>& origin,
                                         const Options& options) {
  std::vector<std::string> warnings;
  const std::string range = range_warning(result, options.range_from);
  if (!range.empty()) warnings.push_back(range);
  const std::string moved = origin_warning(origin, frame.sensor.has_value(), options);
  if (!moved.empty()) warnings.push_back(moved);
  warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
  Aabb box;
  for (std::size_t id = 0; id < result.clusters.size(); ++id)
    box.merge(aabb(result.volume(id, 0)));
  const std::string coarse = coarse_warning(box, frame.points.scalar);
  if (!coarse.empty()) warnings.push_back(coarse);
  return warnings;
}

Status process(const Job& job, const Options& options, FramePipeline& pipeline, Outcome& outcome) {
  Report& report = outcome.report;
  Stopwatch watch;
  const Execution execution = options.pipeline.execution();
  const bool segmented = options.clusters() || options.pipeline.ground.method != GroundMethod::none;
  LoadedCloud loaded(job, segmented || job.labels, execution, options.origin,
                     make_skip_predicate(job, options, pipeline));
  const double read = watch.lap();
  const std::string note = job.recording ? job.recording->new_note(job.number) : loaded.cloud().note;
  if (!note.empty()) report_problem(job.input + ": " + note);
  Frame frame;
  frame.points = loaded.xyz();
  frame.sensor = sensor_of(loaded.cloud());
  if (frame.sensor && loaded.origin()) *frame.sensor -= *loaded.origin();
  frame.recorded_origin = recorded_origin(loaded.origin());
  if (const RawCloud& cloud = loaded.cloud(); !cloud.data.empty())
    frame.intensity = intensity_of(cloud.fields, cloud.data.data(), cloud.point_step);
  if (const auto& field = options.pipeline.cluster.class_field) {
    const bool any = frame.points.count > 0;  // a cloud without points may lack the field
    frame.classes = std::make_shared<std::vector<std::int64_t>>(any ? integers_of(loaded.cloud(), field->name)
                                                                    : std::vector<std::int64_t>());
  }
  const auto found = std::make_shared<FrameResult>();
  FrameResult& result = *found;
  pipeline.set_warnings(FrameWarnings(option_names(false)));  // each cloud has warnings of its own
  pipeline.process(frame, result);
  outcome.result = found;
  if (job.tiles) report.parts = job.tiles->included_count();
  report.points = result.points;
  report.counts = result.counts;
  report.origin = loaded.origin();
  for (const std::string& warning : result_warnings(frame, result, report.origin, options))
    report_problem(job.input + ": " + warning);
  if (options.info) {
    const RawCloud& cloud = loaded.cloud();
    report.info =
        CloudInfo{cloud_statistics(loaded.xyz(), execution), cloud.width, cloud.height, cloud.fields};
  }
  const StageTimes& ms = result.ms;
  if (options.timings) report.seconds = {read, (ms.filter + ms.ground + ms.cluster) / 1e3, ms.fit / 1e3};
  check(loaded.xyz(), result, options, outcome.outside);
  const Status checked = report_failures(report.file, outcome.clusters());
  loaded.require_unchanged();
  return worse(checked, write_files(job, options, frame, outcome, loaded));
}

/// Processes a cloud that is tiled over several inputs. If an input fails, excludes it and processes the
/// cloud again without it.
Status process_tiles(const Job& job, const Options& options, FramePipeline& pipeline, Outcome& outcome) {
  const TileProgress progress(*job.tiles, options);
  Status status = report_excluded_inputs(*job.tiles);
  for (;;) {
    if (job.tiles->included_count() == 0) throw IoError("no input could be read");
    try {
      status = worse(status, options.clusters() ? process_tiled_objects(job, options, outcome.report)
                                                : process(job, options, pipeline, outcome));
      set_left_out(*job.tiles, outcome.report);
      report_notes(*job.tiles);
      return status;
    } catch (const TileError& error) {
      report_problem(job.tiles->jobs()[error.tile()].input + ": " + error.what());
      job.tiles->exclude(error.tile(), error.what());
      status = Status::failed;
    }
  }
}

/// Makes volumes from partial results.
Status process_partials(const Job& job, const Options& options, Report& report) {
  if (options.clusters()) {
    report.file = kTiledName;
    const Status status = merge_object_files(job, job.partials, FileLife::lasting, options, report);
    if (report.error) return status;
    report_ground_warning(report, options);
    return worse(status, worse(report_failures(report), write_mesh(job, report.clusters)));
  }
  Stopwatch watch;
  const std::optional<MergedClouds> clouds = merge_files(job.partials);
  if (!clouds) {  // each file that cannot be merged has been reported
    report.error = "some partial results cannot be merged";
    return Status::failed;
  }
  clouds->require_whole();
  const PartialFile all = clouds->joined();
  const double read = watch.lap();
  const std::vector<const Method*> methods = options.pipeline.methods();
  report = report_of(all, methods);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    Fitted<AnyVolume> fitted = all.partial.fit(*methods[i], method_options(options), execution_of(options));
    set_volume(i, fitted, std::move(fitted.volume), report);
  }
  if (options.timings) report.seconds = {read, 0, watch.lap()};
  return worse(report_failures(report), write_mesh(job, report.clusters));
}

Status process_any(const Job& job, const Options& options, FramePipeline& pipeline, Outcome& outcome) {
  if (!job.partials.empty()) return process_partials(job, options, outcome.report);
  return job.tiles ? process_tiles(job, options, pipeline, outcome)
                   : process(job, options, pipeline, outcome);
}

}  // namespace

ClusterSource Outcome::clusters() const {
  if (result == nullptr) return vector_source(report.clusters);
  const std::size_t methods = result->methods.size();
  return {result->clusters.size(),
          [this, methods, made = cluster_source(*result),
           entry = ClusterEntry()](std::size_t id) mutable -> const ClusterEntry& {
            if (outside.empty()) return made.at(id);
            entry = made.at(id);
            std::size_t n = 0;
            for (std::size_t m = 0; m < methods; ++m) {
              if (!result->is_requested(id, m)) continue;
              VolumeEntry& volume = entry.volumes[n++];
              if (volume.failed.empty()) volume.outside = outside[id * methods + m];
            }
            return entry;
          }};
}

std::vector<ClusterEntry> Outcome::entries() const {
  const ClusterSource source = clusters();
  std::vector<ClusterEntry> all;
  all.reserve(source.count);
  for (std::size_t i = 0; i < source.count; ++i)
    all.push_back(source.at(i));
  return all;
}

Status detail::report_failures(const Report& report) {
  return report_failures(report.file, vector_source(report.clusters));
}

Status detail::report_failures(const std::string& file, const ClusterSource& clusters) {
  Status status = Status::done;
  for (std::size_t i = 0; i < clusters.count; ++i) {
    const ClusterEntry& cluster = clusters.at(i);
    const auto object = [&](const VolumeEntry& entry, Status what, const std::string& problem) {
      std::string line = file + ": cluster " + std::to_string(cluster.id) + ": ";
      line.append(entry.method).append(": ").append(problem);
      report_problem(line);
      status = worse(status, what);
    };
    for (const VolumeEntry& entry : cluster.volumes) {
      if (!entry.failed.empty()) object(entry, Status::failed, entry.failed);
      if (entry.outside.value_or(0) > 0)
        object(entry, Status::outside, std::to_string(*entry.outside) + " points outside");
    }
  }
  return status;
}

Status detail::write_mesh(const Job& job, const std::vector<ClusterEntry>& clusters, const GlbCloud& cloud) {
  if (!job.mesh) return Status::done;
  return write_file(job, *job.mesh, [&] {
    const MeshFormat format = mesh_format(*job.mesh).value_or(MeshFormat::ply);
    if (format == MeshFormat::glb) return write_file_atomically(*job.mesh, volumes_glb(clusters, cloud));
    write_volumes(*job.mesh, clusters, format);
  });
}

std::string detail::coarse_warning(const Aabb& box, ScalarType scalar) {
  const double farthest = box.empty() ? 0 : std::max(box.max().maxCoeff(), -box.min().minCoeff());
  const double step = farthest > 0 ? std::ldexp(1.0, std::ilogb(farthest) - 23) : 0;
  // Checks for steps of 1 cm or more that result from the distance to the origin, not from the size of the
  // cloud.
  const bool coarse =
      scalar == ScalarType::float32 && step >= 0.01 && farthest > 4 * (box.max() - box.min()).norm();
  if (!coarse) return {};
  char text[250];
  std::snprintf(
      text, sizeof text,
      "float32 coordinates near %.3g have a resolution of %.2g, which limits the accuracy of the volumes: "
      "record float64 (then --origin auto) or subtract an origin before recording",
      farthest, step);
  return text;
}

void detail::report_ground_warning(const Report& report, const Options& options) {
  FrameResult counted;
  counted.config = std::make_shared<PipelineConfig>(options.pipeline);
  counted.points = report.points;
  counted.counts = report.counts;
  const std::string warning = ground_warning(counted, option_names(false));
  if (!warning.empty()) report_problem(report.file + ": " + warning);
}

MethodOptions detail::method_options(const Options& options) {
  return options.pipeline.method_options();
}

Outcome detail::process(const Job& job, const Options& options, FramePipeline& pipeline) {
  Outcome outcome;
  outcome.report.file = job.input;
  try {
    outcome.status = process_any(job, options, pipeline, outcome);
    return outcome;
  } catch (const UsageError&) {
    throw;
  } catch (const std::exception& error) {
    outcome.report.error = reason_of(error);
  }
  report_problem(job.input + ": " + *outcome.report.error);
  outcome.status = Status::failed;
  return outcome;
}

}  // namespace pcl_bv
