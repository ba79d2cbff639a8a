// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Processes inputs from the file to the report: one input, or all of them on all cores.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "inputs.h"
#include "options.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/report/report.h"
#include "status.h"

namespace pcl_bv {

/// The outcome of a job.
struct Outcome {
  Report report;  ///< Without clusters if `result` is set: clusters() makes them one by one.
  Status status = Status::done;
  std::shared_ptr<const FrameResult> result;
  /// For each volume of the result, if requested: the number of points outside.
  std::vector<std::size_t> outside;

  /// Return what is reported. The source refers to this object.
  ClusterSource clusters() const;
  std::vector<ClusterEntry> entries() const;
};

/// Processes a job: loads, segments, fits, verifies, and writes the labels, the mesh, the picture and the
/// page. Does not throw for problems with inputs or files. These go to standard error and into the status,
/// and for a failed input also into `report.error`.
Outcome process(const Job& job, const Options& options, FramePipeline& pipeline);

/// Reports failed fits and points outside of volumes on standard error. Returns the resulting status.
Status report_failures(const Report& report);
Status report_failures(const std::string& file, const ClusterSource& clusters);

/// Writes the mesh of the job, if it is requested.
Status write_mesh(const Job& job, const std::vector<ClusterEntry>& clusters);

/// Returns a warning if float32 coordinates are too coarse for a box at this distance from the origin,
/// otherwise an empty text.
std::string coarse_warning(const Aabb& box, ScalarType scalar);

/// Returns the options of the methods.
MethodOptions method_options(const Options& options);

/// Processes all jobs. Writes reports and messages in the order of the jobs, for any number of threads.
///
/// If there are at least as many jobs as threads, each job runs in one thread; otherwise the jobs run one
/// after another, each with all threads. A failed job does not stop the others. If nobody reads the reports
/// any more, the work ends without an error, unless it also writes files or checks volumes. With several
/// jobs, a summary on standard error comes last.
Status process_all(const std::vector<Job>& jobs, const Options& options);

}  // namespace pcl_bv
