// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One input from file to report.

#include "process.h"

#include <chrono>
#include <filesystem>
#include <new>
#include <utility>

#include "command/messages.h"
#include "info.h"
#include "loaded_cloud.h"
#include "pcl_bv/fitting/batch.h"
#include "pcl_bv/fitting/verify.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/pcd.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/report/meshes.h"
#include "pcl_bv/report/picture.h"
#include "segment.h"

namespace pcl_bv {
namespace {

class Stopwatch {
 public:
  /// Seconds since the last call, or since construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Fits all methods around all entries, several entries at a time.
void fit(const Segmentation& segmentation, const Options& options, Report& report) {
  report.clusters.resize(segmentation.entries.size());
  for_each_view(segmentation.entries, options.execution, [&](std::size_t id, const Execution& execution) {
    ClusterEntry& cluster = report.clusters[id];
    cluster.id = id;
    Supports supports;
    const Execution shared = share_supports(segmentation.entries[id], options.methods, execution, supports);
    for (const Method* method : options.methods) {
      VolumeEntry& entry = cluster.volumes.emplace_back();
      entry.method = method->name;
      const EstimationResult result =
          method->fit(segmentation.entries[id], entry.volume, shared, options.method_options);
      entry.failed = result.reason;
      cluster.points = result.used;
      // Then there is one entry: the cloud.
      if (!looks_at_points(options)) report.counts.nonfinite = result.dropped;
    }
  });
}

/// Failed if a fit did; if asked, verifies all other volumes of all entries: outside if a point is.
Status check(const Segmentation& segmentation, const Options& options, Report& report) {
  Status status = Status::done;
  for (ClusterEntry& cluster : report.clusters) {
    const auto object = [&](const VolumeEntry& entry, Status what, const std::string& problem) {
      std::string said = report.file + ": cluster " + std::to_string(cluster.id) + ": ";
      said.append(entry.method).append(": ").append(problem);
      complain(said);
      status = worse(status, what);
    };
    for (VolumeEntry& entry : cluster.volumes) {
      if (!entry.failed.empty()) object(entry, Status::failed, entry.failed);
      if (!entry.failed.empty() || !options.check) continue;
      entry.outside = verify(entry.volume, segmentation.entries[cluster.id], options.execution).outside;
      if (*entry.outside > 0)
        object(entry, Status::outside, std::to_string(*entry.outside) + " points outside");
    }
  }
  return status;
}

/// Runs `write`, which makes the file `path`, and its folder before.
template <typename Write>
Status write_file(const std::filesystem::path& path, const Write& write) {
  try {
    make_folder_of(path);
    write();
    return Status::done;
  } catch (const std::bad_alloc&) {
    complain(path.string() + ": not enough memory");
  } catch (const std::exception& error) {
    complain(path.string() + ": " + error.what());
  }
  return Status::failed;
}

Picture make_picture(const Segmentation& segmentation, const std::vector<std::uint32_t>& labels,
                     const Options& options, const Report& report) {
  Picture picture;
  picture.from = options.view;
  picture.points = options.tolerance ? segmentation.in_range : segmentation.points;
  if (options.tolerance) picture.labels = labels.data();
  for (const ClusterEntry& cluster : report.clusters) {
    for (std::size_t m = 0; m < cluster.volumes.size(); ++m) {
      const std::size_t colour = options.tolerance ? cluster.id : m;
      picture.volumes.push_back({cluster.volumes[m].volume, static_cast<std::uint32_t>(colour)});
    }
  }
  return picture;
}

/// The files that were asked for beside the report. The labels are written into the cloud's own records.
Status write_files(const Job& job, const Options& options, const Segmentation& segmentation,
                   const Report& report, RawCloud cloud) {
  Status status = Status::done;
  if (job.mesh) {
    status = worse(status, write_file(*job.mesh, [&] {
                     const MeshFormat format = mesh_format(*job.mesh).value_or(MeshFormat::ply);
                     write_volumes(*job.mesh, report.clusters, format);
                   }));
  }
  if (!job.labels && !job.image) return status;
  std::vector<std::uint32_t> label;
  if (job.labels || options.tolerance) label = labels(segmentation, report.points);
  if (job.image) {
    status = worse(status, write_file(*job.image, [&] {
                     write_picture(*job.image, make_picture(segmentation, label, options, report));
                   }));
  }
  if (job.labels) {
    status = worse(status, write_file(*job.labels, [&] {
                     set_uint32_field(cloud, "label", label);
                     write_pcd(*job.labels, cloud);
                   }));
  }
  return status;
}

Status process(const Job& job, const Options& options, Report& report) {
  Stopwatch watch;
  Seconds seconds;
  LoadedCloud loaded(job, tells_points_apart(options) || job.labels, options.execution.parallel);
  seconds.read = watch.lap();
  const Segmentation segmentation = segment(loaded.xyz(), options);
  seconds.segment = watch.lap();
  report.points = loaded.cloud().size();
  if (!loaded.cloud().note.empty()) complain(job.input + ": " + loaded.cloud().note);
  report.counts = segmentation.counts;
  fit(segmentation, options, report);
  seconds.fit = watch.lap();
  if (options.info) report.info = cloud_info(loaded.cloud(), loaded.xyz(), options.execution.parallel);
  if (options.timings) report.seconds = seconds;
  const Status checked = check(segmentation, options, report);
  loaded.require_unchanged();
  return worse(checked, write_files(job, options, segmentation, report, loaded.take()));
}

}  // namespace

Outcome process(const Job& job, const Options& options) {
  Outcome outcome;
  outcome.report.file = job.input;
  try {
    outcome.status = process(job, options, outcome.report);
    return outcome;
  } catch (const std::bad_alloc&) {
    outcome.report.error = "not enough memory";
  } catch (const std::exception& error) {
    outcome.report.error = error.what();
  }
  complain(job.input + ": " + *outcome.report.error);
  outcome.status = Status::failed;
  return outcome;
}

}  // namespace pcl_bv
