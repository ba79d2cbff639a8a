// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {

/// Bytes of a file, from `begin` to before `end`.
struct ByteRange {
  std::size_t begin, end;
};

/// Notes that the bytes behind the last point, `rest`, hold more points of `record` bytes: a recorder that
/// stops early leaves their number as it was when it began. A partial record, and less than 4 KiB of zeros as
/// PCL writes them, are ignored. Throws IoError if the header says 0 points.
void note_rest(const InputFile& file, ByteRange rest, std::size_t record, RawCloud& cloud);

}  // namespace pcl_bv
