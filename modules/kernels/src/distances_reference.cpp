// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scalar reference. All in double: one at a time, a double costs what a float does. Compiled with -O3
// -fno-tree-vectorize, so that it stays what benchmarks call scalar.

#include "references.h"

#include <algorithm>

#include "square.h"

namespace pcl_bv {
std::size_t octant(const Coordinates& p, const DistanceCenter& center) {
  const auto bit = [&](double coordinate, double origin) {
    return static_cast<std::size_t>((coordinate - origin) * center.scale > 0);
  };
  return bit(p.x, center.x) | bit(p.y, center.y) << 1 | bit(p.z, center.z) << 2;
}

namespace {

// The greatest distance of one block. A NaN is never greater; an infinity is looked at when it would win.
template <typename T>
double greatest_distance(const PointView& points, const DistanceCenter& center) {
  double greatest = -1;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_as<T>(points, i);
    const double d2 = square(p, center);
    if (d2 > greatest && is_valid(p)) greatest = d2;
  }
  return greatest;
}

// Lets the point compete if it matters; its squared distance, or -1.
double compete(const Coordinates& p, OctantScan& scan) {
  const double d2 = square(p, scan.center);
  if (!is_valid(p)) return -1;
  if (d2 >= scan.limit) {
    double& best = scan.greatest[octant(p, scan.center)];
    best = std::max(best, d2);
  }
  return d2;
}

template <typename T>
void octants(const PointView& block, OctantScan& scan) {
  scan.greatest.fill(-1);
  for (std::size_t begin = 0; begin < block.count; begin += kBoundPoints) {
    double greatest = -1;
    for (std::size_t i = begin; i < std::min(begin + kBoundPoints, block.count); ++i)
      greatest = std::max(greatest, compete(load_as<T>(block, i), scan));
    if (scan.bounds != nullptr) scan.bounds[begin / kBoundPoints] = static_cast<float>(greatest);
  }
}

template <typename T>
std::size_t list(const PointView& points, const DistanceCenter& center, double limit,
                 std::uint32_t* positions) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_as<T>(points, i);
    if (square(p, center) >= limit && is_valid(p)) positions[count++] = static_cast<std::uint32_t>(i);
  }
  return count;
}

}  // namespace

double squared_distance(const Coordinates& p, const DistanceCenter& center) {
  return square(p, center);
}

void block_distances_reference(const PointView& points, const DistanceCenter& center, double /*limit*/,
                               FloatFilter /*filter*/, double* greatest) {
  for (std::size_t begin = 0; begin < points.count; begin += kBlockPoints) {
    const PointView block = points.slice(begin, std::min(kBlockPoints, points.count - begin));
    *greatest++ = points.scalar == ScalarType::float32 ? greatest_distance<float>(block, center)
                                                       : greatest_distance<double>(block, center);
  }
}

void scan_octants_reference(const PointView& block, OctantScan& scan) {
  if (block.scalar == ScalarType::float32) {
    octants<float>(block, scan);
  } else {
    octants<double>(block, scan);
  }
}

std::size_t list_reaching_reference(const PointView& block, const KeptBounds& kept,
                                    const DistanceCenter& center, double limit, std::uint32_t* positions) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < block.count; ++i) {
    if (!(static_cast<double>(kept.bounds[i / kBoundPoints]) * (1 + 0x1p-22) + 0x1p-148 >= kept.limit))
      continue;
    if (square(load_as<float>(block, i), center) >= limit) positions[count++] = static_cast<std::uint32_t>(i);
  }
  return count;
}

std::size_t list_distant_reference(const PointView& points, const DistanceCenter& center, double limit,
                                   FloatFilter /*filter*/, std::uint32_t* positions) {
  return points.scalar == ScalarType::float32 ? list<float>(points, center, limit, positions)
                                              : list<double>(points, center, limit, positions);
}

}  // namespace pcl_bv
