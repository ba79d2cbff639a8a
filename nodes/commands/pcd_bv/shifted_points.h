// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points relative to an origin.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {

/// The points of a view minus an origin, rounded to double. The view must not have an index list.
class ShiftedPoints final : public PointSource {
 public:
  ShiftedPoints(const PointView& points, const Eigen::Vector3d& origin) : points_(points), origin_(origin) {}

  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

 private:
  PointView points_;
  Eigen::Vector3d origin_;
};

/// Returns the centre of the points' axis-aligned box, rounded to whole numbers. Without a valid point,
/// returns 0.
Eigen::Vector3d rounded_centre(const PointView& points, const Execution& execution);

/// Returns where the origin of the coordinates is after `origin` was subtracted, for Frame::recorded_origin.
/// The sensor is assumed there. If the new origin is more than 500 m from the recorded one, the recorded one
/// was not at the sensor, as with the coordinates of a map. Then returns 0: the sensor is assumed at the new
/// origin. The result does not depend on the points, so that all shares of a cloud have the same.
Eigen::Vector3d recorded_origin(const std::optional<Eigen::Vector3d>& origin);

/// Returns a warning if a setting depends on the position of the sensor, but the points were moved so far
/// that nothing is known about it (recorded_origin()); otherwise an empty text. `sensor_known`: the cloud
/// states the position.
std::string origin_warning(const std::optional<Eigen::Vector3d>& origin, bool sensor_known,
                           const Options& options);

/// Returns a copy of all points of a view without gaps, in the scalar type of the view.
std::vector<std::byte> packed_copy(const PointView& points);

}  // namespace pcl_bv::detail
