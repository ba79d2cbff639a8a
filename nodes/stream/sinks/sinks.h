// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The functions that open the sinks of the table in sink_kinds.cpp.
#pragma once

#include <vector>

#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv::detail {

std::unique_ptr<FrameSink> open_jsonl(const SinkOptions& description);
std::unique_ptr<FrameSink> open_csv(const SinkOptions& description);
std::unique_ptr<FrameSink> open_kitti(const SinkOptions& description);
std::unique_ptr<FrameSink> open_vtp(const SinkOptions& description);
std::unique_ptr<FrameSink> open_image(const SinkOptions& description);
std::unique_ptr<FrameSink> open_labels(const SinkOptions& description);
std::unique_ptr<FrameSink> open_dds_sink(const SinkOptions& description);
std::unique_ptr<FrameSink> open_ws_sink(const SinkOptions& description);

/// Returns the sink kinds for recordings, or none in a build without the component `recording`.
std::vector<SinkKind> recording_sinks();

}  // namespace pcl_bv::detail
