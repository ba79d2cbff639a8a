// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of the .ply format made from clouds, with whatever else the format allows around the vertices.
#pragma once

#include <string>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv {
using namespace detail;

struct PlyStyle {
  std::string format = "ascii";  ///< Or binary_little_endian, binary_big_endian.
  bool elements_before = false;  ///< Faces, an element without properties, one with plain values.
  bool list_inside = false;      ///< A list of 0, 1 or 2 shorts between the properties of each vertex.
  bool elements_after = false;
  std::string newline = "\n";
};

/// All combinations of the above.
const std::vector<PlyStyle>& ply_styles();

/// x first, x at an offset, z y x, doubles, every type.
const std::vector<Layout>& ply_layouts();

/// A cloud of that layout as a reader of .ply files should give it.
RawCloud ply_cloud(const Layout& layout, std::size_t points, std::uint32_t seed = 3);

std::string ply_text(const RawCloud& cloud, const PlyStyle& style);

std::string describe(const Layout& layout, const PlyStyle& style);

}  // namespace pcl_bv
