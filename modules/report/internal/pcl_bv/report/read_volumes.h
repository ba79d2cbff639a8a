// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <vector>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// All volumes of a file that pcd_bv or bv_stream has written as JSON, or of one by hand: whatever objects in
/// it have a "shape", with the numbers of report_json(), at any depth up to 64, one document or one a line.
/// Volumes with "empty": true are left out; the others come out bit by bit as they were.
///
/// Throws IoError, which names the entry ("clusters[0].volumes[2]"), for a file that cannot be read, has more
/// than 1 GiB, is no JSON, or has no shape at all; for a shape without its numbers or whose fit failed; and
/// for an entry that is no volume among volumes or in a list called "volumes".
std::vector<AnyVolume> read_volumes(const std::filesystem::path& file);

}  // namespace pcl_bv
