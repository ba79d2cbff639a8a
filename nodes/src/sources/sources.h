// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the table of sources names, and what recordings share.
#pragma once

#include "pcl_bv/nodes/frame_source.h"

namespace pcl_bv {

inline constexpr std::string_view kSynth = "synth:";

std::unique_ptr<FrameSource> open_folder(const std::string& name, const ReplayOptions& options);
std::unique_ptr<FrameSource> open_synth(const std::string& name, const ReplayOptions& options);

/// `length` frames, of these files if there are any, again and again: `load` fills in the cloud of the one at
/// a place, and its owner, and throws if it cannot.
std::unique_ptr<FrameSource> make_replay(std::size_t length, std::vector<std::filesystem::path> files,
                                         const ReplayOptions& options,
                                         std::function<void(std::size_t place, Frame&)> load);

}  // namespace pcl_bv
