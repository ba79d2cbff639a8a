// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Shapes whose smallest sphere, box or hull is harder or easier to find than that of a scanned mesh.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_bv::bench {

/// "ball", "surface" (of a sphere), "golfball" (a sphere with 2 % deep dents), "car" (three visible sides of
/// a box, 2 cm of noise, 20 m away); coordinates x y z after each other, in random order, which spares
/// solvers that go by blocks nothing. Empty for any other name.
std::vector<float> make_shape(const std::string& shape, std::size_t points);

}  // namespace pcl_bv::bench
