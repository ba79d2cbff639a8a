// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Inputs from file to report: one, and all over the cores.
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

struct Outcome {
  Report report;  ///< Its clusters are empty where there is a result: they are made one by one from that.
  Status status = Status::done;
  std::shared_ptr<const FrameResult> result;
  std::vector<std::size_t> outside;  ///< For each of the result's volumes, if it was asked.

  /// What is reported. Views this.
  ClusterSource clusters() const;
  std::vector<ClusterEntry> entries() const;
};

/// Loads, segments, fits, verifies, and writes the labels, the mesh and the picture. Never throws for what
/// the input or a file does: problems go to standard error and into the status, a failed input into
/// `report.error` too.
Outcome process(const Job& job, const Options& options, FramePipeline& pipeline);

/// Complains of fits that failed and of points that were found outside: the status for that.
Status say_what_is_wrong(const Report& report);
Status say_what_is_wrong(const std::string& file, const ClusterSource& clusters);

/// The job's mesh, if there is to be one.
Status write_mesh(const Job& job, const std::vector<ClusterEntry>& clusters);

/// A warning if floats of such magnitude are too coarse for points in this box; else nothing.
std::string coarse_remark(const Aabb& box, ScalarType scalar);

/// What the methods are told.
MethodOptions method_options(const Options& options);

/// Processes all jobs and writes their reports; what is written and said comes in the order of the jobs,
/// whatever the number of threads. At least as many jobs as threads are spread over the threads, each job
/// serial; fewer are done one after another, each with all threads. A job that fails stops no other; when
/// nobody reads the reports any more the work ends without complaint, unless it makes files or checks. With
/// several jobs a summary ends on standard error.
Status process_all(const std::vector<Job>& jobs, const Options& options);

}  // namespace pcl_bv
