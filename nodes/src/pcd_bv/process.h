// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One input from file to report.
#pragma once

#include "inputs.h"
#include "options.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/report/report.h"
#include "status.h"

namespace pcl_bv {

struct Outcome {
  Report report;
  Status status = Status::done;
};

/// Loads, segments, fits, verifies, and writes the labels, the mesh and the picture. Never throws for what
/// the input or a file does: problems go to standard error and into the status, a failed input into
/// `report.error` too.
Outcome process(const Job& job, const Options& options, FramePipeline& pipeline);

}  // namespace pcl_bv
