// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/io/las.h"
#include "pcl_bv/io/posix_file.h"

namespace pcl_bv {

/// One field but x, y and z: where it is in the file's record and where in ours.
struct LasColumn {
  std::size_t from, to;
  std::uint32_t size;    ///< Bytes: 1, 2 or 8.
  unsigned shift, mask;  ///< Of those of 1 byte, which bits it is.
};

struct LasHeader {
  RawCloud cloud;  ///< All but its points.
  std::vector<LasColumn> columns;
  std::size_t data_offset = 0;  ///< Of the first record.
  std::size_t record = 0;       ///< Bytes of a record in the file.
  std::array<double, 3> scale{}, offset{};
};

/// Throws IoError.
LasHeader read_las_header(const InputFile& file);

/// Reads the points into header.cloud.data. Throws IoError.
void read_las_points(const InputFile& file, LasHeader& header);

}  // namespace pcl_bv
