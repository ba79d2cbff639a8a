// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the table of sinks names.
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

/// Recordings; none in a build without recordings.
std::vector<SinkKind> recording_sinks();

}  // namespace pcl_bv
