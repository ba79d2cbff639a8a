// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Warns about points behind the last point that a header announces.
#pragma once

#include <cstddef>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {

/// The bytes [begin, end) of a file.
struct ByteRange {
  std::size_t begin, end;
};

/// Adds a note to the cloud if the bytes `rest` behind the last point contain more points of `record` bytes.
/// A recorder that stopped early may not have updated the number of points in the header. An incomplete
/// record is ignored. Less than 4 KiB of zeros are ignored, too, because PCL appends them. Throws IoError if
/// the header says 0 points but more follow.
void note_trailing_points(const InputFile& file, ByteRange rest, std::size_t record, RawCloud& cloud);

}  // namespace pcl_bv::detail
