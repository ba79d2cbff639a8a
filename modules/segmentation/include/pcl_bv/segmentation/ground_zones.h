// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground removal for outdoor scenes, where roads climb, sink and have curbs, and roadsides are rough. One
// plane (ground_plane.h) fits such ground only near the sensor.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/ground_plane.h"
#include "pcl_bv/segmentation/sensor_position.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Options of GroundZones.
struct GroundZonesOptions {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Direction against gravity; any length above 0.
  /// Centre of the rings in the frame of the cloud, metres. If not given, the centre is the origin if the
  /// points lie around the origin, else the estimate of find_sensor().
  std::optional<Eigen::Vector3d> sensor;
  /// Height of `sensor` above the ground, along up; metres, >= 0. An error of up to ground_height_tolerance
  /// is allowed. If not given, the height is estimated from the cloud. Ignored if the sensor's position is
  /// estimated.
  std::optional<double> sensor_height;
  /// Points at most this far above the ground surface are ground; metres, > 0.
  double distance = 0.15;
  double max_slope_degrees = 20;  ///< Largest angle between the ground and the horizontal, 0 to 89.
  std::uint32_t seed = 1;         ///< Seed of the random search for the first plane.
};

/// Splits clouds of a sensor that stands or drives on the ground into ground and other points.
///
/// Space around the sensor is divided into cells. The cells are rings of 0.5 m, each with 256 sectors. The
/// steps are:
/// - Find the plane around the sensor as split_ground() does, among the points within 12.5 m. If none is
///   found, search within 25 m, then among all points.
/// - Traverse all sectors outwards, ring by ring. The lowest point of a cell is ground if it is near the
///   height expected in its sector. The tolerance grows with the distance since ground was last seen in this
///   sector. A sector without ground for some distance takes its state from the neighbouring sectors.
/// - Interpolate the surface linearly between two cells of a sector with visible ground.
/// - Lower the surface to the highest surface that is nowhere steeper than allowed.
///
/// So the ground may rise and fall, reflections below the ground do not lower it, and roofs and bonnets are
/// not ground.
///
/// As with split_ground(), every point at most `distance` above the surface is ground, however deep below it.
/// In cells with an object (points 0.3 to 2 m above the lowest point of the cell) the limit is a fifth of
/// `distance`, so that the feet of walls and cars are not ground.
///
/// Source: the slope criterion of Vosselman 2000, which compares all pairs of points. Here the distances are
/// propagated from cell to cell (Borgefors 1986).
class GroundZones {
 public:
  /// Allocates nothing until the first split().
  GroundZones();
  ~GroundZones();
  GroundZones(GroundZones&&) noexcept;
  GroundZones& operator=(GroundZones&&) noexcept;

  /// Replaces `split` by the split of `points`. The plane of `split` is the plane around the sensor.
  ///
  /// Points that are not valid (is_valid()) are in neither list. If there is no plane around the sensor, but
  /// a sensor height is given, level ground at that height is assumed (GroundSplit::assumed_level). Without a
  /// height nothing is found and all valid points are in `rest`.
  ///
  /// The same points and options give the same bits for any number of threads. O(n). Memory of about 40
  /// bytes per point is retained for the next call, which does not allocate for a similar cloud. Throws
  /// std::invalid_argument for an option outside its range and std::length_error if a point index exceeds
  /// 2^31 - 1.
  void split(const PointView& points, const GroundZonesOptions& options, GroundSplit& split,
             const Execution& execution = {});

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

/// Splits a cloud by GroundZones with a single call. A program that splits again and again saves allocations
/// with a GroundZones object of its own.
GroundSplit split_ground_by_zones(const PointView& points, const GroundZonesOptions& options = {},
                                  const Execution& execution = {});

}  // namespace pcl_bv
