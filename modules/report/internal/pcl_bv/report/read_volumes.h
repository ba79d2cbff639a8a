// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <vector>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Reads all volumes of a JSON file written by pcd_bv, bv_stream or by hand: all objects with a member
/// "shape" and the numbers of report_json(), at a nesting of up to 64. The file has one JSON value or
/// several, such as one per line. Volumes with "empty": true are left out; all others are equal to the
/// written ones bit for bit.
///
/// Throws IoError, which names the entry ("clusters[0].volumes[2]"), if the file cannot be read, has more
/// than 1 GiB, is not valid JSON or has no volumes; if a shape lacks its numbers or its fit failed; and if an
/// entry next to volumes, or in a list "volumes", is not a volume.
std::vector<AnyVolume> read_volumes(const std::filesystem::path& file);

}  // namespace pcl_bv
