// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "preconditions.h"

#include <stdexcept>
#include <string>

namespace pcl_bv::detail {

void require_at_most(std::size_t maximum, std::size_t count, const char* what) {
  if (count <= maximum) return;
  throw std::invalid_argument(std::to_string(count) + ' ' + what + " are too many; at most " +
                              std::to_string(maximum) + " are allowed");
}

void require_in_memory(const PointView& points, std::size_t maximum) {
  require_at_most(maximum, points.count, "points");
  if (points.source != nullptr || (points.data == nullptr && points.count > 0)) {
    throw std::invalid_argument(
        "the points are not in memory; load them with LoadedPoints before calling a kernel");
  }
}

void require_origin(const PointView& points, const Coordinates& origin) {
  const auto stored = [&](double c) {
    return points.scalar == ScalarType::float64 || static_cast<double>(static_cast<float>(c)) == c;
  };
  if (is_valid(origin) && stored(origin.x) && stored(origin.y) && stored(origin.z)) return;
  throw std::invalid_argument("the origin must be a valid point of the view's scalar type");
}

void require_distances(const PointView& points, const DistanceCenter& center, std::size_t maximum) {
  require_in_memory(points, maximum);
  if (points.scalar == ScalarType::float64 || center.scale == 1) return;
  throw std::invalid_argument("DistanceCenter::scale must be 1 for float points, not " +
                              std::to_string(center.scale));
}

void require_scan_bounds(const PointView& block, const ScanBounds& scanned) {
  if (block.scalar == ScalarType::float32 && scanned.bounds != nullptr) return;
  throw std::invalid_argument(
      "list_distant_by_bounds() needs a block of floats and the bounds that scan_octants() wrote for it");
}

}  // namespace pcl_bv::detail
