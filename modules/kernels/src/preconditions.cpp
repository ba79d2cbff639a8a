// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "preconditions.h"

#include <stdexcept>
#include <string>

namespace pcl_bv {

void require_at_most(std::size_t most, std::size_t count, const char* what) {
  if (count <= most) return;
  throw std::invalid_argument("at most " + std::to_string(most) + ' ' + what + " at a time, not " +
                              std::to_string(count));
}

void require_in_memory(const PointView& points, std::size_t most) {
  require_at_most(most, points.count, "points");
  if (points.source != nullptr || (points.data == nullptr && points.count > 0)) {
    throw std::invalid_argument(
        "kernels take points that are in memory: LoadedPoints brings a source's there");
  }
}

void require_origin(const PointView& points, const Coordinates& origin) {
  const auto stored = [&](double c) {
    return points.scalar == ScalarType::float64 || static_cast<double>(static_cast<float>(c)) == c;
  };
  if (is_valid(origin) && stored(origin.x) && stored(origin.y) && stored(origin.z)) return;
  throw std::invalid_argument("the origin must be a valid point of the view's scalar type");
}

void require_distances(const PointView& points, const DistanceCenter& center, std::size_t most) {
  require_in_memory(points, most);
  if (points.scalar == ScalarType::float64 || center.scale == 1) return;
  throw std::invalid_argument("distances of float points have scale 1, not " + std::to_string(center.scale));
}

void require_scan_bounds(const PointView& block, const ScanBounds& kept) {
  if (block.scalar == ScalarType::float32 && kept.bounds != nullptr) return;
  throw std::invalid_argument("list_reaching() needs the bounds that a scan of float points leaves");
}

}  // namespace pcl_bv
