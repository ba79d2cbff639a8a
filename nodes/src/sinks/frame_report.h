// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Results as io writes them.
#pragma once

#include "pcl_bv/report/frame_report.h"
#include "pcl_bv/nodes/frame_result.h"

namespace pcl_bv {

FrameReport to_report(const FrameResult& result);
FrameReport to_report(const FrameHeader& header, const std::string& error);

}  // namespace pcl_bv
