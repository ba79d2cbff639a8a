// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Used instead of rig_recording.cpp in builds without the component `recording`.

#include "pcl_bv/io/raw_cloud.h"
#include "rig_recording.h"

namespace pcl_bv::detail {

void write_rig_recording(const RigSequence& /*spec*/, const std::filesystem::path& /*file*/) {
  throw IoError("cannot be written: this build lacks the component recording");
}

}  // namespace pcl_bv::detail
