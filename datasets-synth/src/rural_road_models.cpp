// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Models that only the rural road has.
#include "street_model.h"
#include "street_parts.h"

namespace pcl_bv::detail {

Model make_cyclist(SplitMix64& random) {
  const double s = random.uniform(0.95, 1.08);
  std::vector<Part> parts{extrude(Axis::y, regular_polygon(16, 0.34, 0.52, 0.34), -0.03, 0.03),
                          extrude(Axis::y, regular_polygon(16, 0.34, -0.52, 0.34), -0.03, 0.03),
                          box({{-0.45, -0.03, 0.45}, {0.45, 0.03, 0.62}}),
                          box({{0.3, -0.25, 0.95}, {0.4, 0.25, 1.02}}),
                          ellipsoid({0, 0.12, 0.65}, {0.14, 0.08, 0.42}),
                          ellipsoid({0, -0.12, 0.65}, {0.14, 0.08, 0.42}),
                          ellipsoid({0.08, 0, s * 1.28}, {0.22, 0.2, s * 0.36}),
                          ellipsoid({0.22, 0, s * 1.7}, {0.11, 0.09, s * 0.13})};
  return assemble(SynthObjectKind::cyclist, std::move(parts));
}

Model make_low_wall(SplitMix64& random) {
  const double half_length = random.uniform(2.4, 3.3);
  const double height = random.uniform(0.4, 0.8);
  return assemble(SynthObjectKind::wall, {box({{-half_length, -0.15, 0}, {half_length, 0.15, height}})});
}

// A tree whose crown begins above the roofs of cars and extends over the road.
Model make_avenue_tree(SplitMix64& random) {
  const double bottom = random.uniform(3.2, 4), top = bottom + random.uniform(3, 5);
  const double middle = 0.5 * (bottom + top), half = 0.5 * (top - bottom);
  std::vector<Part> parts{extrude(Axis::z, regular_polygon(12, random.uniform(0.18, 0.3)), 0, bottom + 1)};
  for (int i = 0; i < 7; ++i) {
    const double angle = 0.9 * i + random.uniform(-0.3, 0.3), away = i == 0 ? 0 : random.uniform(1.6, 3);
    parts.push_back(
        leaves({away * std::cos(angle), away * std::sin(angle), middle + half * random.uniform(-0.2, 0.2)},
               {1.6, 1.6, 0.8 * half}));
  }
  return assemble(SynthObjectKind::tree, std::move(parts));
}

// A bridge over the road and its ditches. The y axis is across the road.
Model make_bridge(SplitMix64& random) {
  const double soffit = random.uniform(4.6, 5.2), half_width = random.uniform(2, 4);
  return assemble(SynthObjectKind::bridge, {box({{-half_width, -13, soffit}, {half_width, 13, soffit + 0.9}}),
                                            box({{-half_width, -13, -1}, {half_width, -10, soffit}}),
                                            box({{-half_width, 10, -1}, {half_width, 13, soffit}})});
}

}  // namespace pcl_bv::detail
