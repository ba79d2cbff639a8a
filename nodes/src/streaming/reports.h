// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>

#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/report/frame_report.h"

namespace pcl_bv {

FrameReport report_of(const Frame& frame, const FrameResult& result);
FrameReport report_of_lost(const Frame& frame, const std::string& reason);

}  // namespace pcl_bv
