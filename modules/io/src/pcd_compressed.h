// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <string>

#include "input_file.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {

/// Reads the block at `offset` into cloud.data. Throws IoError.
void read_compressed_points(const InputFile& file, std::size_t offset, RawCloud& cloud);

/// The block of all points, without padding fields: two sizes, then the packed bytes. Throws IoError if there
/// is too much to pack.
std::string compress_points(const RawCloud& cloud);

}  // namespace pcl_bv
