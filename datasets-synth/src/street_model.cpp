// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Models of houses, plants, posts and people.
#include "street_model.h"

#include "street_parts.h"

namespace pcl_bv::detail {
namespace {

/// Adds ellipsoids of leaves around the vertical axis, within `radius` of the axis and between the heights
/// `bottom` and `top`.
void add_leaves(std::vector<Part>& parts, SplitMix64& random, double radius, double bottom, double top) {
  const double middle = 0.5 * (bottom + top);
  const double half_height = 0.5 * (top - bottom);
  parts.push_back(leaves({0, 0, middle}, {0.75 * radius, 0.75 * radius, half_height}));
  constexpr int blobs = 7;
  for (int i = 0; i < blobs; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(-0.3, 0.3)) / blobs;
    const double size = random.uniform(0.35, 0.5);
    const double away = (1 - size) * radius;
    const double height = middle + random.uniform(-0.5, 0.3) * half_height;
    parts.push_back(leaves({away * std::cos(angle), away * std::sin(angle), height},
                           {size * radius, size * radius, 0.5 * half_height}));
  }
}

/// Adds a row of window pockets to the front (the face of maximum y) of a house.
void add_windows(Part& house, double bottom, double spacing) {
  const double half_length = house.bounds.hi.x;
  const double front = house.bounds.hi.y;
  for (double x = -half_length + 0.8; x + 1.1 < half_length - 0.3; x += spacing) {
    house.pockets.push_back({{x, front - 0.3, bottom}, {x + 1.1, front + 0.01, bottom + 1.4}});
  }
}

}  // namespace

Model make_pedestrian(SplitMix64& random) {
  const double s = random.uniform(1.5, 1.9) / 1.75;
  const double stride = random.uniform(0.05, 0.22);
  std::vector<Part> parts{ellipsoid({0, 0, s * 1.62}, {s * 0.10, s * 0.08, s * 0.13}),
                          ellipsoid({0, 0, s * 1.16}, {s * 0.14, s * 0.20, s * 0.37}),
                          ellipsoid({stride, s * 0.10, s * 0.44}, {s * 0.09, s * 0.08, s * 0.44}),
                          ellipsoid({-stride, s * -0.10, s * 0.44}, {s * 0.09, s * 0.08, s * 0.44}),
                          ellipsoid({-0.7 * stride, s * 0.25, s * 1.13}, {s * 0.06, s * 0.06, s * 0.32}),
                          ellipsoid({0.7 * stride, s * -0.25, s * 1.13}, {s * 0.06, s * 0.06, s * 0.32})};
  return assemble(SynthObjectKind::pedestrian, std::move(parts));
}

Model make_lamp_post(SplitMix64& random) {
  const double height = random.uniform(5, 6.5);
  return assemble(SynthObjectKind::pole, {extrude(Axis::z, regular_polygon(12, 0.16), 0, 0.9),
                                          extrude(Axis::z, regular_polygon(12, 0.09), 0.9, height)});
}

Model make_sign_post(SplitMix64& random) {
  const double plate = random.uniform(1.7, 2.2);  // height of the middle of the plate
  std::vector<Part> parts{extrude(Axis::z, regular_polygon(12, 0.05), 0, plate + 0.35),
                          extrude(Axis::x, regular_polygon(16, 0.3, 0, plate), -0.08, -0.05)};
  return assemble(SynthObjectKind::pole, std::move(parts));
}

Model make_house(SplitMix64& random) {
  const double half_length = random.uniform(4.5, 6.2);
  const double front = 4;  // the same for all houses, so that the fronts are in line
  const double back = front - random.uniform(8, 10);
  const double eaves = random.uniform(5, 6.5);
  const double ridge = eaves + 2.5;
  Part body =
      extrude(Axis::x, {{back, 0}, {front, 0}, {front, eaves}, {0.5 * (front + back), ridge}, {back, eaves}},
              -half_length, half_length);
  add_windows(body, 1.5, 2.3);
  add_windows(body, 4.2, 2.3);
  const double bay = random.uniform(-half_length + 1.2, half_length - 3.6);
  return assemble(SynthObjectKind::house,
                  {std::move(body), box({{bay, front - 0.5, 0}, {bay + 2.4, front + 0.6, 3.4}})});
}

Model make_hedge_or_wall(SplitMix64& random) {
  const double half_length = random.uniform(2.4, 3.1);
  const double height = random.uniform(0.9, 1.5);
  if (random.uniform() < 0.35) {
    return assemble(SynthObjectKind::wall, {box({{-half_length, -0.12, 0}, {half_length, 0.12, height}})});
  }
  Part hedge = box({{-half_length, -0.35, 0}, {half_length, 0.35, height}});
  hedge.free_path = 0.08;
  return assemble(SynthObjectKind::hedge, {std::move(hedge)});
}

Model make_tree(SplitMix64& random) {
  const double radius = random.uniform(1.1, 1.5);
  const double bottom = random.uniform(1.1, 1.8);
  std::vector<Part> parts{extrude(Axis::z, regular_polygon(12, random.uniform(0.1, 0.16)), 0, bottom + 0.8)};
  add_leaves(parts, random, radius, bottom, bottom + random.uniform(2.5, 4));
  return assemble(SynthObjectKind::tree, std::move(parts));
}

Model make_bush(SplitMix64& random) {
  std::vector<Part> parts;
  const double top =
      random.uniform(1.1, 1.8);  // one after another, since compilers order arguments differently
  const double radius = random.uniform(0.6, 0.9);
  add_leaves(parts, random, radius, 0, top);
  return assemble(SynthObjectKind::tree, std::move(parts));
}

}  // namespace pcl_bv::detail
