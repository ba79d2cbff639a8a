// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Regions of 3D Tiles: west, south, east, north in radians, lowest and highest metres above WGS84's
// ellipsoid.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {

/// Returns longitude, latitude and height of a point of EPSG 4978 (metres from the centre of the Earth).
inline Eigen::Vector3d to_geographic(const Eigen::Vector3d& point) {
  constexpr double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f);
  const double across = std::hypot(point.x(), point.y());
  double latitude = std::atan2(point.z(), across * (1 - e2));
  for (int i = 0; i < 8; ++i) {  // converges to the last bits in 3 to 5 rounds, near the surface
    const double sine = std::sin(latitude);
    latitude = std::atan2(point.z() + a * e2 * sine / std::sqrt(1 - e2 * sine * sine), across);
  }
  const double sine = std::sin(latitude);
  const double height = across * std::cos(latitude) + point.z() * sine - a * std::sqrt(1 - e2 * sine * sine);
  return {std::atan2(point.y(), point.x()), latitude, height};
}

class GeographicRegion {
 public:
  explicit GeographicRegion(const std::array<double, 6>& numbers)
      : low_(numbers[0], numbers[1], numbers[4]), high_(numbers[2], numbers[3], numbers[5]) {}

  /// Makes the region of the finite points, which `to_earth` transforms to EPSG 4978.
  GeographicRegion(const std::vector<double>& points, const Eigen::Matrix4d& to_earth) {
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
      const Eigen::Vector3d p(points[i], points[i + 1], points[i + 2]);
      if (!p.allFinite()) continue;
      const Eigen::Vector3d at = to_geographic((to_earth * p.homogeneous()).head<3>());
      low_ = low_.cwiseMin(at);
      high_ = high_.cwiseMax(at);
    }
  }

  void merge(const GeographicRegion& other) {
    low_ = low_.cwiseMin(other.low_);
    high_ = high_.cwiseMax(other.high_);
  }

  /// Returns the numbers of "region". Throws IoError if the points are not within 1000 km of the ellipsoid,
  /// or if the region seems to cross the 180th meridian: it is wider than half of the Earth.
  std::array<double, 6> numbers() const {
    if (!(std::max(-low_.z(), high_.z()) < 1e6))
      throw IoError("the frame of its points is not EPSG 4978, which a region needs");
    if (!(high_.x() - low_.x() < M_PI) || !(low_.x() <= high_.x()))
      throw IoError("a region across the 180th meridian, or of no points, cannot be computed");
    return {low_.x(), low_.y(), high_.x(), high_.y(), low_.z(), high_.z()};
  }

 private:
  Eigen::Vector3d low_ = Eigen::Vector3d::Constant(HUGE_VAL), high_ = -low_;
};

}  // namespace pcl_bv::detail
