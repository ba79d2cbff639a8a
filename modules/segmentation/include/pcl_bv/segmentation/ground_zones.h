// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground removal for outdoor scenes: roads climb, sink and have curbs, verges are rough, so that one plane
// (ground_plane.h) holds only near the sensor.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>

#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/ground_plane.h"
#include "pcl_bv/segmentation/sensor_place.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What counts as ground.
struct GroundZonesSettings {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Against gravity; any length above 0.
  /// Where the rings are centred, in the cloud's frame, metres. If not given, in the origin, or where the
  /// points are densest if they do not lie around the origin (find_sensor()).
  std::optional<Eigen::Vector3d> sensor;
  /// Height of `sensor` above the ground, along up, metres; >= 0. Learnt from the cloud if not given; if
  /// given, a guess good to ground_height_tolerance. Ignored where the sensor's place is estimated.
  std::optional<double> sensor_height;
  double distance = 0.15;  ///< Points at most this far above the ground's surface are ground, metres; > 0.
  double max_slope_degrees = 20;  ///< Greatest angle between the ground and the horizontal, 0 to 89.
  std::uint32_t seed = 1;         ///< Of the search for the first plane.
};

/// Splits clouds of a sensor that stands or drives on the ground into ground and rest.
///
/// Space around the sensor is cut into cells: rings of half a metre, each in 256 sectors. The plane around
/// the sensor comes first, found like that of split_ground() among the points within 12.5 m. Then all sectors
/// walk outwards ring by ring: a cell's lowest point is ground if it lies near the height that its sector
/// expects there, the nearer the more lately ground was seen; a sector that has lost sight of the ground
/// hears from those beside it. Between two places of a sector where the ground is seen it is the line that
/// connects them. The surface found is lowered to the highest one that is nowhere steeper than allowed. So
/// the ground may rise and fall, reflections below it do not draw it down, and roofs and bonnets do not pass
/// for it.
///
/// Ground is every point at most `distance` above that surface, however deep it lies below, as with
/// split_ground(): reflections from puddles must not become objects. In cells where something stands, with
/// points 0.3 to 2 m above the lowest one, it is a fifth of `distance`: feet of walls and cars are no ground.
///
/// Source: the slope of what is above the lowest points tells ground from objects in Vosselman 2000, there by
/// all pairs of points, here by distances that grow from cell to cell (Borgefors 1986).
class GroundZones {
 public:
  GroundZones();
  ~GroundZones();
  GroundZones(GroundZones&&) noexcept;
  GroundZones& operator=(GroundZones&&) noexcept;

  /// Replaces `split`; its plane is the one around the sensor. Points that are not valid (is_valid()) are in
  /// neither list. Not found, and all valid points `rest`: there is no such plane, as in split_ground(), and
  /// no sensor height is given either (with it, level ground at that height is where the search begins:
  /// GroundSplit::level).
  ///
  /// Same points and settings give the same bits, on however many threads. Throws std::invalid_argument for a
  /// setting outside its range, std::length_error if a point number exceeds 2^31 - 1. O(n); memory is kept
  /// for the next call, about 40 bytes a point, and a cloud like the last one needs no more.
  void split(const PointView& points, const GroundZonesSettings& settings, GroundSplit& split,
             const ParallelPolicy& policy = Serial{});

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace pcl_bv
