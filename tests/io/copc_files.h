// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// COPC files, whose chunks LASzip's own writer has compressed.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl_bv {

/// A node of the octree over the cube from -64 to 64 m.
struct CopcNode {
  std::int32_t level = 0;
  std::array<std::int32_t, 3> at{};
  std::size_t points = 0;
  bool on_second_page = false;
  bool equal = false;  ///< All points are equal.

  /// Returns a bound of the node in metres.
  double low(std::size_t axis) const;
  double side() const;
};

struct CopcFile {
  std::string las, copc;    ///< The same points.
  std::size_t first_entry;  ///< Offset of the tree in `copc`.
};

/// Returns files of random points in the nodes, point format 7, in millimetres.
CopcFile make_copc(const std::vector<CopcNode>& nodes, const std::filesystem::path& folder,
                   unsigned seed = 1);

}  // namespace pcl_bv
