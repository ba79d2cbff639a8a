// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A program that must not compile: the compiler's error has to say what a point type needs.
#include <vector>

#include "pcl_bv/points/point_view.h"

namespace {
struct MixedPoint {
  float x;
  double y;
  float z;
};
}  // namespace

int main() {
  const std::vector<MixedPoint> points(1);
  return static_cast<int>(pcl_bv::view(points).count);
}
