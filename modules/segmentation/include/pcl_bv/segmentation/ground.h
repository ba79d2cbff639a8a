// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground removal, without PCL. split_ground() finds one plane, for floors and flat roads. GroundZones is for
// outdoor scenes, where roads rise, fall and have curbs, and roadsides are rough. split_ground_by_slope() is
// for maps, which have no position of a sensor. The ground has to be removed before clustering, because the
// ground would connect all objects.
//
// find_sensor() estimates the position of the sensor. GroundZones measures distances from this position.
// Range limits and ClusterOptions::tolerance_per_metre use distances from the origin, so they are right only
// if the sensor is at the origin.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Options of split_ground().
struct GroundPlaneOptions {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Direction against gravity; any length above 0.
  /// Points at most this far above the plane are ground; metres, > 0.
  double distance = 0.2;
  double max_slope_degrees = 15;  ///< Largest angle between the plane's normal and up, 0 to 89.
  /// Height of `sensor` above the ground, along up; metres, >= 0. If set, the plane must be this far below
  /// the sensor, to within ground_height_tolerance.
  std::optional<double> sensor_height;
  std::uint32_t seed = 1;      ///< Seed of the random search. Other seeds may move the plane by millimetres.
  unsigned iterations = 1000;  ///< Number of planes tried, 1 to 1000000.
  /// Position of the sensor, only for sensor_height; each coordinate is from -1e100 to 1e100.
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();
};

/// Largest accepted error of the option sensor_height, metres. The value is large enough for pitching
/// vehicles and uneven ground. It is small enough to exclude car bonnets and tables, which are 0.7 m high and
/// more.
inline constexpr double ground_height_tolerance = 0.5;

/// Buffers that calls of split_ground() reuse.
struct GroundScratch {
  std::vector<Eigen::Vector3d> sample, support, lowest;
};

/// Position of the sensor of a cloud, found by find_sensor().
struct SensorPosition {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< In the frame of the cloud, metres.
  /// Whether the points lie around the position `assumed` of find_sensor(). If not, `position` is an
  /// estimate.
  bool confirmed = true;
  /// Share of points that are 100 m or farther from `position`, 0 to 1. Computed only by find_sensor(), from
  /// a sample of at least 100 points; otherwise 0.
  double far_share = 0;
};

/// A cloud split into ground and other points. Reusing an object reuses its memory.
struct GroundSplit {
  bool found = false;  ///< Whether there is a plane. If not, all valid points are in `rest`.
  /// Unit normal of the plane, pointing up; 0 if there is no plane. The height of a point p above the plane
  /// is normal.p - offset.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double offset = 0;  ///< Metres, in the frame of the cloud.
  /// Centre of the rings of GroundZones. It is GroundZonesOptions::sensor if that option is set, otherwise
  /// the result of find_sensor(). The value of the option is not compared with the points. split_ground()
  /// does not set this member.
  SensorPosition sensor{};
  /// Whether GroundZones found no plane and assumed level ground at sensor_height. Not set by split_ground().
  bool assumed_level = false;
  /// Indices of the ground points in the cloud (PointView::index()), in the order of the view.
  std::vector<std::int32_t> ground;
  std::vector<std::int32_t> rest;  ///< Indices of the other valid points.
  GroundScratch scratch;           ///< Internal buffers.
};

/// Finds the ground as one plane and splits the points by it.
///
/// Ground is every point with (nx*x + ny*y) + nz*z - offset <= distance, computed in double. So all points
/// below the plane are ground, at any depth, e.g. reflections from puddles and windows, or ground that slopes
/// down. Objects below the plane are treated as ground, too. For hilly scenes use GroundZones.
///
/// A plane is allowed if it satisfies max_slope_degrees and sensor_height. The result is the allowed plane
/// with the smallest cost. Points near a plane cost little. A point clearly below a plane costs as much as
/// four points clearly above the plane. So a floor is preferred to a table, and a road to a roof, if the
/// lower surface has more than a quarter of the points of the upper one. The search weights points by the
/// area that they cover seen from above, so that dense rings near the sensor do not outweigh the distant
/// road. Least squares over the sampled points near the plane then refine the plane. Three points are enough
/// if their plane is allowed.
///
/// Points that are not valid (is_valid()) are in neither list. No plane is found in these cases:
/// - There are fewer than three valid points, or all points are on a line.
/// - No plane is allowed.
/// - Each plane has at least a third as many points below it as near it.
///
/// The same points and options give the same bits. The cost is O(n) in addition to a search of
/// constant cost. `split` retains 8 bytes per point for the next call. Throws std::invalid_argument for an
/// option outside its range and std::length_error if a point index exceeds 2^31 - 1.
///
/// Source: RANSAC (Fischler, Bolles 1981) with the truncated cost MSAC (Torr, Zisserman 2000), then least
/// squares.
void split_ground(const PointView& points, const GroundPlaneOptions& options, GroundSplit& split);

/// Returns the split as a new object.
GroundSplit split_ground(const PointView& points, const GroundPlaneOptions& options = {});

/// Options of GroundZones.
struct GroundZonesOptions {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Direction against gravity; any length above 0.
  /// Centre of the rings in the frame of the cloud, metres. If not set, the centre is the origin if the
  /// points lie around the origin, else the estimate of find_sensor().
  std::optional<Eigen::Vector3d> sensor;
  /// Height of `sensor` above the ground, along up; metres, >= 0. An error of up to ground_height_tolerance
  /// is allowed. If not set, the height is estimated from the cloud. The option is ignored if the sensor's
  /// position is estimated.
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
/// - Traverse all sectors outwards, ring by ring. The lowest point of a cell is ground if its height is near
///   the height expected in the sector. The tolerance grows with the distance from the last ground cell of
///   this sector. If ground was seen more recently in the neighbouring sectors, their expected heights and
///   slopes are mixed into those of the sector.
/// - Interpolate the surface linearly between two cells of a sector with visible ground.
/// - Lower the surface where it is too steep. The result is the highest surface that is nowhere above the
///   interpolated surface and nowhere steeper than max_slope_degrees.
/// - In cells with an object, lower the surface to the mean of the cells on both sides, one or two sectors
///   away.
///
/// So the ground may rise and fall, reflections below the ground do not lower it, and roofs and bonnets are
/// not ground.
///
/// As with split_ground(), every point at most `distance` above the surface is ground, and so are all points
/// below the surface. A cell has an object if it has points 0.3 to 2 m above its lowest point. In such cells
/// the limit is a fifth of `distance`, so that the feet of walls and cars are not ground. The banks of a
/// ditch have no object: a cell whose lowest point is ground, and more than 0.1 m below the expected height.
///
/// Source: the slope criterion of Vosselman 2000, which compares all pairs of points. Here distances are path
/// lengths from cell to cell (Borgefors 1986).
class GroundZones {
 public:
  /// Allocates nothing until the first split().
  GroundZones();
  ~GroundZones();
  GroundZones(GroundZones&&) noexcept;
  GroundZones& operator=(GroundZones&&) noexcept;

  /// Replaces `split` by the split of `points`. The plane of `split` is the plane around the sensor.
  ///
  /// Points that are not valid (is_valid()) are in neither list. If there is no plane around the sensor,
  /// level ground at options.sensor_height is assumed (GroundSplit::assumed_level). If this height is not set
  /// or is ignored, no ground is found and all valid points are in `rest`.
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

/// Options of split_ground_by_slope().
struct GroundSlopeOptions {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Direction against gravity; any length above 0.
  /// Points at most this far above the ground surface are ground; metres, > 0.
  double distance = 0.2;
  double max_slope_degrees = 20;  ///< Largest angle between the ground and the horizontal, 0 to 89.
  double cell_size = 1;           ///< Side of the cells of the grid, metres, 0.01 to 1000.
};

/// Splits a map into ground and other points. A map is a cloud without a sensor position, such as a mobile or
/// airborne scan. Roofs, vehicles and trees are not ground, because they are higher than the ground next to
/// them by more than the maximum slope allows.
///
/// A grid of square cells is laid perpendicular to `up`. The steps are:
/// - Each cell stores the height of its lowest point.
/// - Low outliers, e.g. reflections, are found. Cells within 3 cells of each other are linked if their
///   heights differ by at most distance + max_slope * cell_size, where max_slope is the tangent of
///   max_slope_degrees. Linked cells are a patch. A cell is above another one if its height exceeds that of
///   the other by more than distance + max_slope * (distance of both centres). A cell of a patch of less than
///   20 cells is a low outlier if a cell of a larger patch within 10 cells is above it.
/// - The surface in the centre of a cell c is the minimum of low(c') + max_slope * |c - c'| over all cells c'
///   that are no low outliers. This is the lower envelope of cones.
/// - Within a cell the surface is a plane. Along each axis of the grid, its slope is that to the next cell or
///   that from the previous cell, whichever is less steep. The slope is 0 if the signs differ or if one of
///   these cells has no points. The plane is raised by half of its rise along each axis, because the lowest
///   point of a cell is at its lower edge.
///
/// Every point at most `distance` above the surface is ground, and so are all points below the surface. So
/// the inner part of a roof is ground if the roof reaches max_slope * (distance to its edge) above the ground
/// there: a flat roof of 10 m with 20 degrees 27 m from its edge. Parts of ground that are steeper than
/// max_slope_degrees, such as walls, are not ground. A bridge is not ground above the road it crosses and as
/// far as the slope demands, but ground at its ends.
///
/// Points that are not valid (is_valid()) are in neither list. With at least one valid point, ground is
/// found; GroundSplit::normal, offset and sensor have no meaning. The order of the points and the number of
/// threads do not change the result. Cells 2^31 or more cells away from the origin are merged with the cells
/// at the border. O(n) and O(m log m) for m cells with points. Takes 1 byte for each point and up to 150
/// bytes for each cell. Throws std::invalid_argument for an option outside its range and std::length_error if
/// a point index exceeds 2^31 - 1.
///
/// Source: the slope criterion of Vosselman 2000, with lowest points of cells instead of all points.
void split_ground_by_slope(const PointView& points, const GroundSlopeOptions& options, GroundSplit& split,
                           const Execution& execution = {});

/// Returns the split as a new object.
GroundSplit split_ground_by_slope(const PointView& points, const GroundSlopeOptions& options = {},
                                  const Execution& execution = {});

/// Checks whether a sensor at the position `assumed` may have recorded the cloud. If not, estimates the
/// position of the sensor.
///
/// The check uses a sample of at most 1024 valid points, without the points at (0, 0, 0) and at `assumed`,
/// which are rays without a return. Distances are horizontal, i.e. perpendicular to `up`, in metres. Most
/// points of a LiDAR are near the sensor. In recorded sweeps at least 72 % of the points are within 12.5 m of
/// the sensor. At most 3 % are within 12.5 m of a position 30 m away from the sensor. So the points are
/// treated as lying around `assumed` if one of these holds:
/// - At least 5 % of the points are within 12.5 m of `assumed`.
/// - At least 5 % are within 25 m of `assumed`, and no other position has half of the points within 12.5 m.
///   This covers a sensor that is high up or looks far ahead.
/// - The sample has fewer than 100 points.
///
/// Returns `assumed` if the points lie around it. Otherwise returns the mean of the points within 12.5 m of
/// the densest position, at the height of `assumed`. The same points give the same bits. O(1) if most points
/// are valid. Throws std::invalid_argument if `up` is 0 or not finite, or if a coordinate of `assumed` is not
/// from -1e100 to 1e100.
SensorPosition find_sensor(const PointView& points, const Eigen::Vector3d& up, const Eigen::Vector3d& assumed,
                           GroundScratch& scratch);

/// An up direction and its share of ground points.
struct OtherUp {
  Eigen::Vector3d up;  ///< Direction against gravity.
  double share;        ///< Share of the points near the ground plane, 0 to 1.
};
/// Looks for a better up direction, for which many more points of the cloud are ground.
///
/// The directions are z, -y, y, -z, x, -x and (0, -1, -1), tried in this order with the distance and slope of
/// `options`. In a camera's frame -y is up. If the camera looks down, (0, -1, -1) is up. Directions close to
/// options.up are skipped. `found` is the share of ground points for options.up. If `found` is above 0, only
/// the direction opposite to options.up is tried. For the other directions a wall could be taken for the
/// ground, because a wall may be larger than the ground. A direction is accepted if all of these hold:
/// - It has a ground plane at least 0.2 m below `sensor`.
/// - At most a tenth as many points are below the plane as near it.
/// - The share of points near the plane is at least 3 % and at least three times `found`.
/// - This share is at most 95 %, because a cloud of one plane has no clear up direction.
///
/// Returns the first accepted direction. If there is none, returns nothing. Takes at most seven plane
/// searches among 2048 points, some milliseconds each. Throws std::invalid_argument if options.up is 0 or
/// not finite. The other options are not checked.
std::optional<OtherUp> find_other_up(const PointView& points, const GroundPlaneOptions& options,
                                     const Eigen::Vector3d& sensor, double found);

}  // namespace pcl_bv
