// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground removal by many planes, for outdoor scenes: roads climb, sink and have curbs, so that one plane
// (ground_plane.h) holds only near the sensor.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>

#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/segmentation/ground_plane.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What counts as ground.
struct GroundZonesSettings {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Against gravity; any length above 0.
  Eigen::Vector3d sensor =
      Eigen::Vector3d::Zero();  ///< Where the zones are centred, in the cloud's frame, metres.
  /// Height of `sensor` above the ground, along up, metres; >= 0. Learnt from the cloud if not given; if
  /// given, a guess good to ground_height_tolerance.
  std::optional<double> sensor_height;
  double distance = 0.15;  ///< Points at most this far above their zone's plane are ground, metres; > 0.
  double max_slope_degrees = 20;  ///< Greatest angle between a zone's plane and the horizontal, 0 to 89.
  std::uint32_t seed = 1;         ///< Of the search for the first plane.
};

/// Splits clouds of a sensor that stands or drives on the ground into ground and rest.
///
/// The ground is cut into 504 patches: rings around the sensor, each in sectors. The plane around the sensor
/// comes first, found like that of split_ground() among the points within 12.5 m; then, from the innermost
/// ring outwards, each patch looks near its inner neighbour's plane for the lowest height at which points are
/// many and fits a plane to these; a patch that shows too little ground takes over its neighbour's plane. So
/// the ground may rise and fall with the distance, reflections below it do not draw it down, and roofs and
/// bonnets do not pass for it.
///
/// Ground is every point at most `distance` above the plane of its patch, however deep it lies below, as with
/// split_ground(): reflections from puddles must not become objects.
///
/// Source: region-wise plane fitting in concentric zones (Patchwork: Lim, Oh and Myung 2021).
class GroundZones {
 public:
  GroundZones();
  ~GroundZones();
  GroundZones(GroundZones&&) noexcept;
  GroundZones& operator=(GroundZones&&) noexcept;

  /// Replaces `split`; its plane is the one around the sensor. Points that are not valid (is_valid()) are in
  /// neither list. Not found, and all valid points `rest`: there is no such plane, as in split_ground(), and
  /// no sensor height is given either (with it, level ground at that height is where the search begins).
  ///
  /// Same points and settings give the same bits, on however many threads. Throws std::invalid_argument for a
  /// setting outside its range, std::length_error if a point number exceeds 2^31 - 1. O(n); memory is kept for
  /// the next call, about 40 bytes a point, and a cloud like the last one needs no more.
  void split(const PointView& points, const GroundZonesSettings& settings, GroundSplit& split,
             const ParallelPolicy& policy = Serial{});

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace pcl_bv
