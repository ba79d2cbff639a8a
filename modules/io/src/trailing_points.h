// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Warns about points behind the last point that a header announces.
#pragma once

#include <cstddef>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {

/// The bytes [begin, end) of a file.
struct ByteRange {
  std::size_t begin, end;
};

/// Adds a note to the cloud if the bytes behind the last point, `rest`, have more points of `record` bytes: a
/// recorder that stopped early may not have updated the header. An incomplete record is ignored, and so are
/// zeros of less than 4 KiB, which PCL appends. Throws IoError if the header says 0 points but more follow.
void note_trailing_points(const InputFile& file, ByteRange rest, std::size_t record, RawCloud& cloud);

}  // namespace pcl_bv
