// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>

#include "pcl_bv/synth/rig_drive.h"

namespace pcl_bv::detail {

/// Writes the drive of a robot with two LiDARs as an MCAP file: the clouds on /front/points and /rear/points,
/// the poses of the sensors on /tf_static and of the robot on /tf. Throws IoError if the file cannot be
/// written.
void write_rig_recording(const RigSequence& spec, const std::filesystem::path& file);

}  // namespace pcl_bv::detail
