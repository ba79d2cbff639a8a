// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// An encoder of tables of chunks, as LASzip and writers of COPC write them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_bv {

struct LazTableEntry {
  std::uint32_t points, bytes;
};

/// Returns the table as in the file, with or without the points.
std::string laz_table(const std::vector<LazTableEntry>& entries, bool with_points);

}  // namespace pcl_bv
