// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The functions that open the sinks of the table in sink_kinds.cpp.
#pragma once

#include <vector>

#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv {

std::unique_ptr<FrameSink> open_jsonl(const SinkDescription& description);
std::unique_ptr<FrameSink> open_csv(const SinkDescription& description);
std::unique_ptr<FrameSink> open_vtp(const SinkDescription& description);
std::unique_ptr<FrameSink> open_image(const SinkDescription& description);
std::unique_ptr<FrameSink> open_labels(const SinkDescription& description);
std::unique_ptr<FrameSink> open_dds_sink(const SinkDescription& description);
std::unique_ptr<FrameSink> open_ws_sink(const SinkDescription& description);

/// Returns the sink kinds for recordings, or none in a build without the component `recording`.
std::vector<SinkKind> recording_sinks();

}  // namespace pcl_bv
