// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <array>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/obb.h"

namespace pcl_bv {
using namespace detail;

namespace {

// Components of axes that differ by at most `same_component` are treated as equal. The value is larger than
// rounding errors and much smaller than any rotation that matters.
constexpr double same_component = 1e-9;

Eigen::Vector3d pointing_positive(const Eigen::Vector3d& axis) {
  const double largest = axis.cwiseAbs().maxCoeff();
  for (const double c : axis) {
    if (std::abs(c) >= largest - same_component) return c < 0 ? Eigen::Vector3d(-axis) : axis;
  }
  return axis;
}

// Returns whether axis a precedes axis b. Both must be results of pointing_positive(). Axes are ordered by
// the magnitude of their x components, largest first, then y, then z. If all magnitudes are equal, the axes
// are ordered by the signs, positive first.
bool comes_first(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  for (int k = 0; k < 3; ++k) {
    const double difference = std::abs(a[k]) - std::abs(b[k]);
    if (std::abs(difference) > same_component) return difference > 0;
  }
  for (int k = 0; k < 3; ++k) {
    if (std::abs(a[k] - b[k]) > same_component) return a[k] > b[k];
  }
  return false;
}

// Returns the coordinate axis from which yaw() is measured: x, or y if `up` is less than 45 degrees from x.
int yaw_reference(const Eigen::Vector3d& up) {
  return std::abs(up.x()) > 0.7071067811865476 ? 1 : 0;
}

// Components of axis 0 of a box: `ahead` along the reference axis of yaw(), `left` a quarter turn
// counter-clockwise from it.
struct Heading {
  double ahead, left;
};

Heading heading_of(const Eigen::Matrix3d& axes) {
  const int k = yaw_reference(axes.col(2));
  return {axes(k, 0), 0.0 - axes(k, 1)};
}

// Rotates axes 0 and 1 by half a turn if necessary, so that the yaw is from -pi/2 (exclusive) to pi/2.
void limit_yaw(Eigen::Matrix3d& axes) {
  const Heading heading = heading_of(axes);
  const bool sideways = std::abs(heading.ahead) <= same_component;
  if (sideways ? heading.left < 0 : heading.ahead < 0) axes.leftCols<2>() = -axes.leftCols<2>();
}

using Order = std::array<int, 3>;

Obb with_axes(const Obb& box, const Order& order, const Eigen::Matrix3d& axes) {
  const Eigen::Vector3d& h = box.half_extents();
  return {box.center(), axes, {h[order[0]], h[order[1]], h[order[2]]}};
}

}  // namespace

Eigen::Matrix3d orthonormal_axes(const Eigen::Matrix3d& axes) {
  const FloatEnvironment environment;
  const Eigen::Vector3d u = unit3(axes.col(0));
  Eigen::Vector3d v = axes.col(1);
  for (int round = 0; round < 2; ++round) {  // the second round removes rounding errors of the first
    const double along = dot3(u, v);
    v = unit3(v - along * u);
  }
  Eigen::Matrix3d result;
  result << u, v, unit3(cross3(u, v));
  return result;
}

Obb Obb::canonical() const {
  const FloatEnvironment environment;
  if (empty()) return *this;
  const double same_size = 0x1p-40 * half_extents_.maxCoeff() +
                           0x1p-50 * center_.cwiseAbs().maxCoeff();  // for rounding of the centre
  Order order{0, 1, 2};
  std::array<Eigen::Vector3d, 3> axes;
  for (int i = 0; i < 3; ++i)
    axes[i] = pointing_positive(axes_.col(i));
  const auto size = [&](int i) { return half_extents_[i]; };
  const auto axis = [&](int i) { return axes[i]; };
  std::sort(order.begin(), order.end(), [&](int i, int j) { return size(i) > size(j); });
  for (std::size_t begin = 0; begin < 3;) {
    std::size_t end = begin + 1;
    while (end < 3 && size(order[end - 1]) - size(order[end]) <= same_size)
      ++end;
    std::sort(order.begin() + begin, order.begin() + end,
              [&](int i, int j) { return comes_first(axis(i), axis(j)); });
    begin = end;
  }
  Eigen::Matrix3d sorted;
  sorted << axis(order[0]), axis(order[1]), axis(order[2]);
  return with_axes(*this, order, sorted);  // Obb's constructor negates axis 2 if the axes are left-handed
}

Obb Obb::upright(const Eigen::Vector3d& up) const {
  const FloatEnvironment environment;
  if (empty()) return *this;
  Eigen::Index vertical = 0;
  const Eigen::Vector3d along{dot3(axes_.col(0), up), dot3(axes_.col(1), up), dot3(axes_.col(2), up)};
  along.cwiseAbs().maxCoeff(&vertical);
  const auto third = static_cast<int>(vertical), first = (third + 1) % 3, second = (third + 2) % 3;
  Eigen::Matrix3d axes;
  axes << axes_.col(first), axes_.col(second), axes_.col(third);
  if (along[vertical] < 0) axes.rightCols<2>() = -axes.rightCols<2>();
  limit_yaw(axes);
  Eigen::Matrix3d quarter;
  quarter << axes.col(1), -axes.col(0), axes.col(2);
  limit_yaw(quarter);
  const double same_size = 0x1p-40 * half_extents_.maxCoeff() + 0x1p-50 * center_.cwiseAbs().maxCoeff();
  const double longer = half_extents_[second] - half_extents_[first];
  const Heading a = heading_of(axes), b = heading_of(quarter);
  const double nearer = std::abs(b.ahead) - std::abs(a.ahead);
  const bool square = std::abs(longer) <= same_size, diagonal = std::abs(nearer) <= same_component;
  const bool swap_axes = !square ? longer > 0 : !diagonal ? nearer > 0 : b.left > a.left;
  if (swap_axes) return with_axes(*this, {second, first, third}, quarter);
  return with_axes(*this, {first, second, third}, axes);
}

double Obb::yaw() const {
  const FloatEnvironment environment;
  const Heading heading = heading_of(axes_);
  return empty() ? kNan : std::atan2(heading.left, heading.ahead);
}

Obb Obb::oriented_as(const Obb& previous) const {
  const FloatEnvironment environment;
  if (empty() || previous.empty()) return *this;
  Order order{0, 1, 2}, best = order;
  Eigen::Vector3d best_signs = Eigen::Vector3d::Ones();
  double largest = -4;
  do {
    Eigen::Vector3d along, signs;
    for (int i = 0; i < 3; ++i) {
      along[i] = dot3(axes_.col(order[i]), previous.axes_.col(i));
      signs[i] = along[i] < 0 ? -1 : 1;
    }
    const bool even = (order[1] - order[0] + 3) % 3 == 1;  // permutations 012, 120, 201
    if ((signs.prod() > 0) != even) {
      // The axes are left-handed. Negating the axis with the smallest |along| reduces the sum least.
      Eigen::Index smallest;
      along.cwiseAbs().minCoeff(&smallest);
      signs[smallest] = -signs[smallest];
    }
    const double sum = dot3(along, signs);
    if (sum <= largest) continue;
    largest = sum;
    best = order;
    best_signs = signs;
  } while (std::next_permutation(order.begin(), order.end()));
  Eigen::Matrix3d axes;
  for (int i = 0; i < 3; ++i)
    axes.col(i) = best_signs[i] * axes_.col(best[i]);
  return with_axes(*this, best, axes);
}

}  // namespace pcl_bv
