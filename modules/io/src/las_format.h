// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pcl_bv/io/las.h"
#include "pcl_bv/io/posix_file.h"

namespace pcl_bv {

struct LasHeader {
  RawCloud cloud;                 ///< All but its points.
  std::vector<std::size_t> from;  ///< Of each field, where it is in the file's record.
  std::size_t data_offset = 0;    ///< Of the first record.
  std::size_t record = 0;         ///< Bytes of a record in the file.
  std::array<double, 3> scale{}, offset{};
};

/// Throws IoError.
LasHeader read_las_header(const InputFile& file);

/// Reads the points into header.cloud.data. Throws IoError.
void read_las_points(const InputFile& file, LasHeader& header);

}  // namespace pcl_bv
