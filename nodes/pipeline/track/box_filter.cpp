// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

constexpr double kVoteDecay = 0.9;          // share of weight that older votes keep per frame
constexpr double kVoteLead = 2;             // lead over axis 0 with which another direction becomes axis 0
constexpr double kMovingDecay = 0.5;        // share of weight that older yaws keep per frame; moving object
constexpr double kStaticDecay = 0.97;       // share of weight that older yaws keep per frame; static object
constexpr double kMaxGrowth = 0.15;         // metres per frame; largest growth of a size
constexpr std::size_t kFreeDetections = 5;  // first detections, in which sizes grow without a limit
constexpr double kHeadingSpeed = 2;         // m/s; from here on the direction of motion counts as a yaw

// Rotates axes 0 and 1 about axis 2 by quarters of a turn. In one quarter, axis 1 becomes axis 0.
Eigen::Matrix3d rotated_by_quarters(const Eigen::Matrix3d& axes, int quarters) {
  Eigen::Matrix3d result = axes;
  for (int i = 0; i < quarters; ++i) {
    const Eigen::Vector3d front = result.col(1);
    result.col(1) = -result.col(0);
    result.col(0) = front;
  }
  return result;
}

// Rotates the axes about axis 2 by an angle. The bits of axis 2 do not change.
Eigen::Matrix3d about_third(const Eigen::Matrix3d& axes, double angle) {
  Eigen::Matrix3d from_third;
  from_third << axes.col(2), std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1), axes.col(1);
  from_third = orthonormal_axes(from_third);
  Eigen::Matrix3d result;
  result << from_third.col(1), from_third.col(2), axes.col(2);
  return result;
}

// Finds the slab along each axis that contains all valid points, relative to `origin`. Widens the slabs
// slightly, so that Obb::contains() is true for every point in spite of rounding errors.
void slabs_of(const PointView& points, const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin,
              Eigen::Vector3d& low, Eigen::Vector3d& high) {
  double farthest = 0;
  low.setConstant(std::numeric_limits<double>::infinity());
  high = -low;
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
    const LoadedPoints loaded = load_chunk(points, chunk);
    for (std::size_t i = 0; i < loaded.view().count; ++i) {
      const Coordinates point = load_point(loaded.view(), i);
      if (!is_valid(point)) continue;
      const Eigen::Vector3d from = Eigen::Vector3d(point.x, point.y, point.z) - origin,
                            projection = axes.transpose() * from;
      low = low.cwiseMin(projection);
      high = high.cwiseMax(projection);
      farthest = std::max(farthest, from.cwiseAbs().sum() + origin.cwiseAbs().sum());
    }
  }
  const double margin = 16 * std::numeric_limits<double>::epsilon() * farthest;
  low.array() -= margin;
  high.array() += margin;
}

}  // namespace

Obb BoxFilter::align_axes(const Obb& box, const BoxState& state) {
  if (box.empty()) return box;
  const Eigen::Matrix3d rotation = state.sensor.linear();
  Obb aligned = box;
  if (known_) {
    const Eigen::Matrix3d axes = orthonormal_axes(rotation.transpose() * axes_);
    aligned = box.oriented_as(Obb(box.center(), axes, box.half_extents()));
  }
  if (state.moving && upright_) {
    int best = 0;
    for (int k = 1; k < 4; ++k) {
      if (rotated_by_quarters(aligned.axes(), k).col(0).dot(state.velocity) >
          rotated_by_quarters(aligned.axes(), best).col(0).dot(state.velocity))
        best = k;
    }
    for (double& vote : votes_)
      vote *= kVoteDecay;
    votes_[static_cast<std::size_t>(best)] += 1;
    if (best != 0 && votes_[static_cast<std::size_t>(best)] > votes_[0] + kVoteLead) {
      Eigen::Vector3d half = aligned.half_extents();
      if (best % 2 == 1) std::swap(half.x(), half.y());
      aligned = Obb(aligned.center(), rotated_by_quarters(aligned.axes(), best), half);
      std::rotate(votes_.begin(), votes_.begin() + best, votes_.end());
      if (best % 2 == 1) std::swap(sizes_[0], sizes_[1]);
    }
  }
  known_ = true;
  axes_ = rotation * aligned.axes();
  return aligned;
}

double BoxFilter::smoothed_yaw(const Obb& box, const BoxState& state) {
  const double yaw =
      Obb(box.center(), orthonormal_axes(state.sensor.linear() * box.axes()), box.half_extents()).yaw();
  if (!state.merged) {
    const double decay = state.moving ? kMovingDecay : kStaticDecay;
    // Longer boxes have more weight, because the direction of a long side is more accurate.
    const double weight = box.half_extents().head<2>().maxCoeff();
    cosine_ = decay * cosine_ + weight * std::cos(4 * yaw);
    sine_ = decay * sine_ + weight * std::sin(4 * yaw);
    const Eigen::Vector3d velocity = state.sensor.linear() * state.velocity;
    if (state.moving && velocity.head<2>().norm() > kHeadingSpeed) {
      const double heading = std::atan2(velocity.y(), velocity.x());
      cosine_ += weight * std::cos(4 * heading);
      sine_ += weight * std::sin(4 * heading);
    }
  }
  if (cosine_ == 0 && sine_ == 0) return 0;
  // The result is the rotation from the yaw of the box to the mean yaw, radians.
  return std::remainder(std::atan2(sine_, cosine_) / 4 - yaw, std::acos(0.0));
}

double BoxFilter::grown_size(std::size_t axis, double seen, bool merged) {
  double& size = sizes_[axis];
  if (seen > size && !merged) {
    const double more = seen - size;
    size = detections_ <= kFreeDetections ? seen : size + std::min(0.3 * more, kMaxGrowth);
  }
  return std::max(size, seen);
}

Obb BoxFilter::smoothed(const Obb& box, const PointView& points, const BoxState& state, bool smooth,
                        bool grow) {
  if (box.empty() || !upright_) return box;
  if (state.separated) {
    sizes_ = {};
    detections_ = 0;
  }
  if (!state.merged) ++detections_;
  Eigen::Matrix3d axes = box.axes();
  if (smooth) {
    axes = about_third(axes, smoothed_yaw(box, state));
    axes_ = state.sensor.linear() * axes;  // the next align_axes() compares with the smoothed axes
  }
  Eigen::Vector3d low, high;
  slabs_of(points, axes, box.center(), low, high);
  if (!(low.array() <= high.array()).all()) return box;
  if (!grow) return Obb::from_slabs(axes, box.center(), low, high);
  ObjectSlabs slabs{axes, box.center(), low, high};
  for (int i = 0; i < 2; ++i)
    slabs.grow(i, grown_size(static_cast<std::size_t>(i), slabs.size(i), state.merged),
               high_face_share(slabs, i, *state.around.viewpoints));
  const bool moves = state.moving && state.velocity.head<2>().norm() > kHeadingSpeed;
  if (state.extends_vehicles)
    extend_vehicle(slabs, moves ? state.velocity : Eigen::Vector3d::Zero(), state.around);
  return Obb::from_slabs(axes, box.center(), slabs.low, slabs.high);
}

}  // namespace pcl_bv::detail
