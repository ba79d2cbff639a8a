// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Results as report writes them.
#pragma once

#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/report/frame_report.h"

namespace pcl_bv {

FrameReport to_report(const Frame& frame, const FrameResult& result);
FrameReport to_report(const Frame& frame, const std::string& error);

}  // namespace pcl_bv
