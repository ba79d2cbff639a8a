// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Obb::overlaps() and Obb::merged(). Finding the smallest box around two boxes would be expensive. So
// merged() returns the smallest box of three orientations.
#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/obb.h"

namespace pcl_bv {
using namespace detail;

namespace {

// A total order of boxes, so that merged() is commutative.
bool precedes(const Obb& a, const Obb& b) {
  const auto numbers = [](const Obb& box) {
    Eigen::Matrix<double, 15, 1> all;
    all << box.half_extents(), box.center(), box.axes().reshaped();
    return all;
  };
  const auto of_a = numbers(a), of_b = numbers(b);
  return std::lexicographical_compare(of_b.begin(), of_b.end(), of_a.begin(), of_a.end());
}

bool is_smaller(const Obb& a, const Obb& b) {
  return a.volume() != b.volume() ? a.volume() < b.volume() : a.surface_area() < b.surface_area();
}

// Returns an upper bound of axis . (to - from).
double projection_up(const Eigen::Vector3d& axis, const Eigen::Vector3d& to, const Eigen::Vector3d& from) {
  return Expansion().add_dot(axis, to).add_dot(-axis, from).up();
}

// Returns the third orientation for merged(). If both boxes have the same third axis, as upright boxes have,
// the result has that third axis. Otherwise the result is the coordinate axes.
Eigen::Matrix3d third_orientation(const Eigen::Vector3d& third, const Eigen::Vector3d& other_third) {
  if (third != other_third) return Eigen::Matrix3d::Identity();
  Eigen::Index smallest = 0;
  third.cwiseAbs().minCoeff(&smallest);
  Eigen::Matrix3d from_third;
  from_third << third, Eigen::Vector3d::Unit(smallest), Eigen::Vector3d::Zero();
  from_third = orthonormal_axes(from_third);
  Eigen::Matrix3d axes;
  axes << from_third.col(1), from_third.col(2), third;
  return axes;
}

}  // namespace

bool Obb::overlaps(const Obb& other) const {
  const FloatEnvironment environment;
  if (empty() || other.empty()) return false;
  const Eigen::Vector3d between = other.center_ - center_;
  const double size =
      (between.lpNorm<1>() + half_extents_.sum() + other.half_extents_.sum()) + kSmallestNormal;
  const auto apart = [&](const Eigen::Vector3d& direction) {
    double limit = 4e-12 * size;
    for (int i = 0; i < 3; ++i) {
      limit += half_extents_[i] * std::abs(dot3(axes_.col(i), direction));
      limit += other.half_extents_[i] * std::abs(dot3(other.axes_.col(i), direction));
    }
    return std::abs(dot3(between, direction)) > limit;
  };
  for (int i = 0; i < 3; ++i) {
    if (apart(axes_.col(i)) || apart(other.axes_.col(i))) return false;
    for (int j = 0; j < 3; ++j) {
      if (apart(axes_.col(i).cross(other.axes_.col(j)))) return false;
    }
  }
  return true;
}

bool Obb::certainly_contains(const Obb& other) const {
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = axes_.col(i);
    const double away =
        std::max(projection_up(axis, other.center_, center_), projection_up(axis, center_, other.center_));
    if (add_up(away, other.support_value_up(axis)) > half_extents_[i]) return false;
  }
  return true;
}

Obb Obb::merged(const Obb& other) const {
  const FloatEnvironment environment;
  if (other.empty()) return *this;
  if (empty()) return other;
  const bool this_first = precedes(*this, other);
  const Obb& first = this_first ? *this : other;
  const Obb& second = this_first ? other : *this;
  if (first.certainly_contains(second)) return first;
  if (second.certainly_contains(first)) return second;
  const auto along = [&](const Eigen::Matrix3d& axes) {
    Eigen::Vector3d low, high;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = axes.col(i), origin = Eigen::Vector3d::Zero();
      const double a = first.support_value_up(axis), b = second.support_value_up(axis);
      high[i] = std::max(add_up(projection_up(axis, first.center_, origin), a),
                         add_up(projection_up(axis, second.center_, origin), b));
      low[i] = -std::max(add_up(projection_up(axis, origin, first.center_), a),
                         add_up(projection_up(axis, origin, second.center_), b));
    }
    return from_slabs(axes, low, high);
  };
  Obb best = along(first.axes_);
  for (const Eigen::Matrix3d& axes :
       {second.axes_, third_orientation(first.axes_.col(2), second.axes_.col(2))}) {
    const Obb box = along(axes);
    if (is_smaller(box, best)) best = box;
  }
  return first.axes_.col(2) == second.axes_.col(2) ? best.upright(first.axes_.col(2)) : best;
}

}  // namespace pcl_bv
