// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Processes one input, or all inputs on all cores, from the file to the report.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "inputs.h"
#include "options.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/report/meshes.h"
#include "pcl_bv/report/report.h"
#include "status.h"

namespace pcl_bv::detail {

/// The outcome of a job.
struct Outcome {
  Report report;  ///< Without clusters if `result` is set; see clusters().
  Status status = Status::done;
  std::shared_ptr<const FrameResult> result;
  /// For each volume of `result`, the number of points outside, if --check was given.
  std::vector<std::size_t> outside;

  /// Return the entries of the reported clusters, one by one or as a list. The ClusterSource refers to this
  /// object.
  ClusterSource clusters() const;
  std::vector<ClusterEntry> entries() const;
};

/// Processes a job: loads the cloud, finds clusters, fits and checks volumes, and writes the labels, the
/// mesh, the picture and the HTML page. Problems with inputs or files are not thrown, but reported on
/// standard error. They change the status. For a failed input, `report.error` is set, too. Throws UsageError.
Outcome process(const Job& job, const Options& options, FramePipeline& pipeline);

/// Reports failed fits and points outside of volumes on standard error. Returns the resulting status.
Status report_failures(const Report& report);
Status report_failures(const std::string& file, const ClusterSource& clusters);

/// Warns on standard error if no point or each point of a cloud is ground.
void report_ground_warning(const Report& report, const Options& options);

/// Writes the mesh of the job, if it is requested. A .glb file also has the points of the cloud.
Status write_mesh(const Job& job, const std::vector<ClusterEntry>& clusters, const GlbCloud& cloud = {});

/// Returns a warning if float32 coordinates are too coarse for a box at this distance from the origin.
/// Otherwise returns an empty text.
std::string coarse_warning(const Aabb& box, ScalarType scalar);

MethodOptions method_options(const Options& options);

/// Processes all jobs. Writes reports and messages in the order of the jobs, for any number of threads.
///
/// If there are at least as many jobs as threads, each job runs in one thread. Otherwise the jobs run one
/// after another, each with all threads. A failed job does not stop the others. If the reports have no reader
/// any more, the work ends without an error, unless the command also writes files or checks volumes. For
/// several jobs, a summary on standard error comes last.
Status process_all(const std::vector<Job>& jobs, const Options& options);

}  // namespace pcl_bv::detail
