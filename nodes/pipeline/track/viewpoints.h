// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The positions from which a frame was measured. They decide which objects may be occluded and which faces of
// an object are visible.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/aabb.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Faces of an object along one axis that the sensors of a frame may see. `both` if the sensors are on both
/// sides of the object, or if one of them is between the faces.
enum class VisibleFace : std::uint8_t { low, high, both };

/// The sensors of a frame, in the frame of the points, metres. z is up.
class Viewpoints {
 public:
  /// A single sensor at the origin.
  Viewpoints() = default;
  /// Returns Viewpoints().
  static const Viewpoints& single();

  /// Replaces the sensors by those of a merged cloud (Frame::sensors) that sent a cloud for this frame. If
  /// there are none, there is a single sensor at `otherwise`.
  ///
  /// `points` are the points of the merged cloud that passed the filter. They tell in which directions a
  /// sensor measures. Invalid points are ignored. Reads at most about 4096 points of each sensor.
  void find(const std::vector<SensorPart>& sensors, const PointView& points,
            const Eigen::Vector3d& otherwise = Eigen::Vector3d::Zero());

  /// Returns whether the position is occluded for every sensor. It is occluded for a sensor if a box is in
  /// between (occludes()). It is also treated as occluded for a sensor of a merged cloud that has no points
  /// in the direction of the position, seen from above, because this sensor could not see an object there.
  /// The box with the index `own`, if any, is left out.
  bool occluded(const Eigen::Vector3d& position, const std::vector<Aabb>& boxes,
                std::size_t own = static_cast<std::size_t>(-1)) const;

  /// Returns the visible faces of a slab: the positions p with low <= axis.dot(p - origin) <= high.
  VisibleFace visible_face(const Eigen::Vector3d& axis, const Eigen::Vector3d& origin, double low,
                           double high) const;

 private:
  struct Viewpoint {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    // Bit k: it has points in sector k. A circle seen from above has 64 sectors.
    std::uint64_t sectors = ~std::uint64_t{0};
  };
  std::vector<Viewpoint> viewpoints_{1};
};

/// Returns the position of the sensor nearest to the point, among those that sent a cloud. Returns
/// `otherwise` if there is none.
Eigen::Vector3d nearest_sensor(const std::vector<SensorPart>& sensors, const Eigen::Vector3d& point,
                               const Eigen::Vector3d& otherwise);

}  // namespace detail
}  // namespace pcl_bv
