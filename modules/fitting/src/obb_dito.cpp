// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// DiTO, the ditetrahedron of Larsson and Kallberg 2011: the two tetrahedra on a large triangle of extremal
// points have seven triangles, and each edge of each is tried as an axis.

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "obb_axes.h"
#include "sphere_seed.h"

namespace pcl_bv {
namespace {

// Local coordinates have an extent from 1 to 2. What is thinner than 1e-10 of it, squared, is flat.
constexpr double kThin = 1e-10;

struct Best {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  double half_area = std::numeric_limits<double>::infinity();

  void compete(const FewPoints& few, const Eigen::Vector3d& edge, const Eigen::Vector3d& normal) {
    const Eigen::Vector3d e = edge.normalized();
    Eigen::Matrix3d frame;
    frame << e, normal, e.cross(normal);
    const double area = pcl_bv::half_area(few, frame);
    if (area < half_area) {
      axes = frame;
      half_area = area;
    }
  }

  void compete(const FewPoints& few, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
               const Eigen::Vector3d& c) {
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    if (normal.squaredNorm() < kThin * kThin) return;
    const Eigen::Vector3d n = normal.normalized();
    compete(few, b - a, n);
    compete(few, c - b, n);
    compete(few, a - c, n);
  }
};

// The two points of a direction's ends that are farthest apart.
void farthest_pair(const Extremes& extremes, const LocalFrame& frame, Eigen::Vector3d& p,
                   Eigen::Vector3d& q) {
  double greatest = -1;
  for (std::size_t k = 0; k < direction_count(DirectionSet::dop14); ++k) {
    const Eigen::Vector3d low = frame.local(extremes.low_point[k].point);
    const Eigen::Vector3d high = frame.local(extremes.high_point[k].point);
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

Eigen::Matrix3d along_line(const Eigen::Vector3d& e) {
  Eigen::Index least = 0;
  e.cwiseAbs().minCoeff(&least);
  Eigen::Matrix3d axes;
  axes << e, Eigen::Vector3d::Unit(least), Eigen::Vector3d::Zero();
  return orthonormal_axes(axes);
}

}  // namespace

FewPoints few_points(const PointView& points, const Extremes& extremes, const LocalFrame& frame) {
  const bool all = points.count <= 2 * direction_count(extremes.set);
  const SeedPoints seeds = all ? SeedPoints(points) : SeedPoints(extremes);
  FewPoints few;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    few.push_back(frame.local(seeds[i].point));
  return few;
}

double half_area(const FewPoints& few, const Eigen::Matrix3d& axes) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Eigen::Vector3d& p : few) {
    for (int i = 0; i < 3; ++i) {
      const double along = (axes(0, i) * p.x() + axes(1, i) * p.y()) + axes(2, i) * p.z();
      low[i] = std::min(low[i], along);
      high[i] = std::max(high[i], along);
    }
  }
  const Eigen::Vector3d size = high - low;
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

Eigen::Matrix3d dito_axes(const FewPoints& few, const Extremes& extremes, const LocalFrame& frame) {
  Best best;
  if (!(frame.extent() > 0)) return best.axes;
  best.half_area = half_area(few, best.axes);
  Eigen::Vector3d p0 = few[0], p1 = few[0];
  farthest_pair(extremes, frame, p0, p1);
  const Eigen::Vector3d e = (p1 - p0).normalized();
  const Eigen::Vector3d p2 = farthest_from_line(few, p0, e);
  const Eigen::Vector3d normal = (p1 - p0).cross(p2 - p0);
  if (normal.squaredNorm() < kThin * kThin) return along_line(e);
  best.compete(few, p0, p1, p2);
  const auto below = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return normal.dot(a - p0) < normal.dot(b - p0);
  };
  const auto [lowest, highest] = std::minmax_element(few.begin(), few.end(), below);
  for (const Eigen::Vector3d* apex : {lowest, highest}) {
    if (std::abs(normal.dot(*apex - p0)) < kThin * normal.norm()) continue;
    best.compete(few, p0, p1, *apex);
    best.compete(few, p1, p2, *apex);
    best.compete(few, p2, p0, *apex);
  }
  return best.axes.isIdentity(0) ? best.axes : orthonormal_axes(best.axes);
}

}  // namespace pcl_bv
