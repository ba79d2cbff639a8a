// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// DiTO, the ditetrahedron of Larsson, Kallberg 2011. Two tetrahedra with a common large triangle of extremal
// points have seven triangles. For each triangle, three frames are tried. Each frame has one axis along the
// triangle's normal and one axis along an edge.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "box/obb_axes.h"
#include "same_points.h"

namespace pcl_bv::detail {
namespace {

// Points thinner than this limit are treated as flat. The unit is that of local coordinates, in which the
// extent is from 1 to 2.
constexpr double kThin = 1e-10;

// The coordinates of a few points as lanes of floats, so that all points are projected at the same time.
class PointLanes {
 public:
  explicit PointLanes(const FewPoints& few) {
    for (std::size_t i = 0; i < kCount; ++i) {
      const Eigen::Vector3f p = few[std::min(i, few.size() - 1)].cast<float>();
      const auto lane = static_cast<Eigen::Index>(i);
      x_[lane] = p.x();
      y_[lane] = p.y();
      z_[lane] = p.z();
    }
  }

  float extent(const Eigen::Vector3d& axis) const {
    const Eigen::Vector3f a = axis.cast<float>();
    const Array along = (a.x() * x_ + a.y() * y_) + a.z() * z_;
    return along.maxCoeff() - along.minCoeff();
  }

 private:
  static constexpr std::size_t kCount = 16;  // at least the 14 support points
  using Array = Eigen::Array<float, static_cast<int>(kCount), 1>;
  Array x_, y_, z_;
};

struct Best {
  explicit Best(const FewPoints& few) : lanes(few) {
    const auto size = [&](int axis) { return lanes.extent(Eigen::Vector3d::Unit(axis)); };
    half_area = size(0) * size(1) + size(1) * size(2) + size(2) * size(0);
  }

  void compete(const Eigen::Vector3d& edge, const Eigen::Vector3d& normal, float thickness) {
    const Eigen::Vector3d e = edge.normalized(), f = e.cross(normal);
    const float length = lanes.extent(e), width = lanes.extent(f);
    const float area = length * width + thickness * (length + width);
    if (!(area < half_area)) return;
    axes << e, normal, f;
    half_area = area;
  }

  void compete(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    if (normal.squaredNorm() < kThin * kThin) return;
    const Eigen::Vector3d n = normal.normalized();
    const float thickness = lanes.extent(n);
    compete(b - a, n, thickness);
    compete(c - b, n, thickness);
    compete(a - c, n, thickness);
  }

  PointLanes lanes;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  float half_area;
};

// Each direction has a pair of support points. Finds the pair whose points are farthest apart.
void farthest_pair(const Supports& supports, const LocalFrame& frame, Eigen::Vector3d& p,
                   Eigen::Vector3d& q) {
  double greatest = -1;
  for (std::size_t k = 0; k < direction_count(DirectionSet::dop14); ++k) {
    const Eigen::Vector3d low = frame.local(supports.along[k].low_point.point);
    const Eigen::Vector3d high = frame.local(supports.along[k].high_point.point);
    if ((high - low).squaredNorm() <= greatest) continue;
    greatest = (high - low).squaredNorm();
    p = low;
    q = high;
  }
}

const Eigen::Vector3d& farthest_from_line(const FewPoints& few, const Eigen::Vector3d& p,
                                          const Eigen::Vector3d& e) {
  const auto squared = [&](const Eigen::Vector3d& x) { return (x - p).cross(e).squaredNorm(); };
  return *std::max_element(few.begin(), few.end(),
                           [&](const auto& a, const auto& b) { return squared(a) < squared(b); });
}

}  // namespace

Eigen::Matrix3d axes_from(const Eigen::Vector3d& e) {
  Eigen::Index least = 0;
  e.cwiseAbs().minCoeff(&least);
  Eigen::Matrix3d axes;
  axes << e, Eigen::Vector3d::Unit(least), Eigen::Vector3d::Zero();
  return orthonormal_axes(axes);
}

FewPoints support_or_all_points(const PointView& points, const Supports& supports, const LocalFrame& frame) {
  FewPoints few;
  const std::size_t directions = direction_count(supports.set);
  if (supports.used + supports.dropped <= 2 * directions) {
    for_each_valid(points, supports,
                   [&](std::size_t, const Coordinates& p) { few.push_back(frame.local(p)); });
    return few;
  }
  for (std::size_t k = 0; k < directions; ++k) {
    few.push_back(frame.local(supports.along[k].low_point.point));
    few.push_back(frame.local(supports.along[k].high_point.point));
  }
  return few;
}

Eigen::Matrix3d dito_axes(const FewPoints& few, const Supports& supports, const LocalFrame& frame) {
  if (!(frame.extent() > 0)) return Eigen::Matrix3d::Identity();
  Best best(few);
  Eigen::Vector3d p0 = few[0], p1 = few[0];
  farthest_pair(supports, frame, p0, p1);
  const Eigen::Vector3d e = (p1 - p0).normalized();
  const Eigen::Vector3d p2 = farthest_from_line(few, p0, e);
  const Eigen::Vector3d normal = (p1 - p0).cross(p2 - p0);
  if (normal.squaredNorm() < kThin * kThin) return axes_from(e);
  best.compete(p0, p1, p2);
  const auto below = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return normal.dot(a - p0) < normal.dot(b - p0);
  };
  const auto [lowest, highest] = std::minmax_element(few.begin(), few.end(), below);
  for (const auto& apex : {lowest, highest}) {
    if (std::abs(normal.dot(*apex - p0)) < kThin * normal.norm()) continue;
    best.compete(p0, p1, *apex);
    best.compete(p1, p2, *apex);
    best.compete(p2, p0, *apex);
  }
  return best.axes.isIdentity(0) ? best.axes : orthonormal_axes(best.axes);
}

}  // namespace pcl_bv::detail
