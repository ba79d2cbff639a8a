// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "hull/hull_fit.h"
#include "hull/support_tree.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "schedule.h"

namespace pcl_bv::detail {
namespace {

using Normals = std::vector<Eigen::Vector3d>;

// Appends v / |v|. A v whose squares could underflow is the normal of a triangle without an area, and is
// skipped.
void add_unit(const Eigen::Vector3d& v, Normals& normals) {
  constexpr double kNoLength = 0x1p-400;
  if (v.cwiseAbs().maxCoeff() > kNoLength) normals.push_back((v / norm3(v)).array() + 0.0);
}

void add_both(const Eigen::Vector3d& v, Normals& normals) {
  add_unit(v, normals);
  add_unit(-v, normals);
}

// Returns the normals of the hull's planes. First come the normals of the triangles. For a flat hull, which
// has no triangles, first come both normals along each flat direction, then the normals of the polygon's
// edges or of the segment's ends. The normals of the axis-aligned box come last. Without the box, the planes
// of two faces that meet at a small angle could, due to rounding, intersect far beyond the points.
Normals normals_of(const LocalHull& hull) {
  Normals normals;
  const auto at = [&](std::int32_t i) { return hull.vertices[static_cast<std::size_t>(i)].local; };
  for (const Triangle& t : hull.triangles)
    add_unit((at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])), normals);
  for (int k = 2; k >= hull.rank && hull.rank < 3; --k)
    add_both(hull.axes.col(k), normals);
  if (hull.rank == 1) add_both(hull.axes.col(0), normals);
  if (hull.rank == 2) {
    const auto corners = static_cast<std::int32_t>(hull.vertices.size());
    for (std::int32_t i = 0; i < corners; ++i)
      add_unit((at((i + 1) % corners) - at(i)).cross(hull.axes.col(2)), normals);
  }
  for (int k = 0; k < 3; ++k)
    add_both(Eigen::Vector3d::Unit(k), normals);
  return normals;
}

// Removes repeated normals. The remaining normals are in the order of their first appearance.
void drop_repeated(Normals& normals) {
  std::vector<std::size_t> order(normals.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  const auto key = [&](std::size_t i) {
    return std::make_tuple(normals[i].x(), normals[i].y(), normals[i].z(), i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
  const auto equal = [&](std::size_t i, std::size_t j) { return normals[i] == normals[j]; };
  order.erase(std::unique(order.begin(), order.end(), equal), order.end());
  std::sort(order.begin(), order.end());
  Normals kept;
  for (const std::size_t i : order)
    kept.push_back(normals[i]);
  normals = std::move(kept);
}

// Calls measure(plane) for all planes. A thread takes 100 planes at a time, because a plane takes only about
// 10 us on a smooth surface.
template <typename Measure>
void for_each_plane(const FitExecution& execution, std::size_t planes, const Measure& measure) {
  constexpr std::size_t kTogether = 100;
  const ParallelPolicy policy = worthwhile(execution, Work::hull_plane, planes);
  for_each_range(policy, planes, kTogether, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      measure(i);
  });
}

}  // namespace

EstimationResult fit_hull(const PointView& points, Hull& hull, const FitExecution& execution) {
  hull = Hull();
  return fit_on_hull(points, execution, [&](const LocalHull& local, const LocalFrame&, const Supports&) {
    Normals normals = normals_of(local);
    drop_repeated(normals);
    const SupportTree tree(local.candidates, normals.size());
    std::vector<HullPlane> planes(normals.size());
    const auto measure = [&](std::size_t i) { planes[i] = {normals[i], tree.max_projection_up(normals[i])}; };
    for_each_plane(execution, normals.size(), measure);
    std::vector<Eigen::Vector3d> vertices;
    for (const HullPoint& v : local.vertices)
      vertices.push_back(vector(v.point));
    hull = Hull(std::move(vertices), local.triangles, std::move(planes), local.rank);
  });
}

}  // namespace pcl_bv::detail
