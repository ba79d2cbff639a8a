// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Computes the smallest box. For hulls of few vertices, all pairs of edges are compared (flush_search.h). For
// other hulls, a search starts from many frames. It rotates each frame about one of its axes after another
// while the volume decreases. For each axis, rotating calipers give the smallest rectangle around the outline
// along the axis (Barequet, Har-Peled 2001; Chang et al. 2011). The worse half of the frames is dropped
// repeatedly (Karnin, Koren, Somekh 2013). The volume that this search finds is usually within a few
// thousandths of the minimum, occasionally within a few hundredths.

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <vector>

#include "box/box_frame.h"
#include "box/flush_search.h"
#include "box/obb_axes.h"
#include "box/rectangle.h"
#include "box/silhouette.h"
#include "hull/local_hull.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "schedule.h"

namespace pcl_bv::detail {
namespace {

// Returns random rotations that are the same on every machine. They are computed from seeded random integers,
// which give unit quaternions.
std::vector<Eigen::Matrix3d> random_rotations(std::size_t count) {
  std::vector<Eigen::Matrix3d> frames;
  std::mt19937_64 random(1);
  const auto component = [&] { return static_cast<double>(random() >> 40) * 0x1p-23 - 1; };
  while (frames.size() < count) {
    Eigen::Vector4d q;
    for (double& c : q)
      c = component();
    const double squared = q.squaredNorm();
    if (squared > 1 || squared < 0.01) continue;
    frames.push_back(orthonormal_axes(Eigen::Quaterniond(q / std::sqrt(squared)).toRotationMatrix()));
  }
  return frames;
}

// Adds frames with an axis along the normal of a facet, for the largest facets.
void add_facets(const LocalHull& hull, std::vector<Eigen::Matrix3d>& frames) {
  constexpr std::size_t kFacets = 20;
  constexpr double kNoNormal = 1e-20;  // squared length, below which a normal is only a rounding error
  std::vector<Eigen::Vector3d> normals;
  for (const Triangle& t : hull.triangles) {
    const auto at = [&](std::size_t k) { return hull.vertices[static_cast<std::size_t>(t[k])].local; };
    normals.push_back((at(1) - at(0)).cross(at(2) - at(0)));
  }
  std::stable_sort(normals.begin(), normals.end(),
                   [](const auto& a, const auto& b) { return a.squaredNorm() > b.squaredNorm(); });
  for (std::size_t i = 0; i < std::min(kFacets, normals.size()); ++i)
    if (normals[i].squaredNorm() > kNoNormal) frames.push_back(axes_from(normals[i].normalized()));
}

// All pairs of edges are compared for hulls of at most this number of vertices. For larger hulls this would
// take too long, because the time grows quadratically.
constexpr std::size_t kExhaustive = 128;

// Numbers of frames in the search. The starts include `random_starts` random frames. Only the best
// `rotated_starts` starts are rotated. Of these, only the best `finalists` frames are rotated to the end. If
// pairs of edges are compared afterwards (kBeforePairs), a box within some percent of the minimum is enough.
struct Effort {
  std::size_t random_starts, rotated_starts, finalists;
};
constexpr Effort kSearch = {60, 40, 8}, kBeforePairs = {8, 6, 2};

// The first three starts are the axes of DiTO, the axes of PCA and the coordinate axes. The resulting box
// must not be larger than the boxes along these axes.
constexpr std::size_t kGuaranteedStarts = 3;

std::vector<Eigen::Matrix3d> start_frames(const PointView& points, const Summary& summary,
                                          const LocalFrame& frame, const LocalHull& hull,
                                          const Effort& effort) {
  Supports supports = summary.supports;
  supports.set = DirectionSet::dop14;  // the directions of dop14 come first in dop26
  static const std::vector<Eigen::Matrix3d> rotations = random_rotations(kSearch.random_starts);
  std::vector<Eigen::Matrix3d> frames{
      dito_axes(support_or_all_points(points, supports, frame), supports, frame), principal_axes(summary),
      Eigen::Matrix3d::Identity()};
  add_facets(hull, frames);
  frames.insert(frames.end(), rotations.begin(),
                rotations.begin() + static_cast<std::ptrdiff_t>(effort.random_starts));
  return frames;
}

Eigen::Matrix3d flat_axes(const LocalHull& hull) {
  std::vector<Eigen::Vector2d> flat;
  const Eigen::Vector3d u = hull.axes.col(0), v = hull.axes.col(1);
  for (const HullPoint& vertex : hull.vertices)
    flat.emplace_back(u.dot(vertex.local), v.dot(vertex.local));
  const Eigen::Vector2d side =
      smallest_rectangle(flat.data(), to_convex_chain(flat.data(), flat.size())).side;
  Eigen::Matrix3d axes;
  axes << hull.axes.col(2), side.x() * u + side.y() * v, Eigen::Vector3d::Zero();
  return orthonormal_axes(axes);
}

void shrink_all(std::vector<BoxFrame>& frames, int times, const Silhouette& shape,
                const FitExecution& execution) {
  constexpr std::size_t kFramesPerChunk = 4;
  constexpr double kSmaller = 1e-9;  // A smaller decrease of the area is not worth another rotation.
  const std::size_t vertices = frames.size() * static_cast<std::size_t>(times) * shape.vertices().size();
  const ParallelPolicy policy = worthwhile(execution, Work::silhouette, vertices);
  for_each_range(policy, frames.size(), kFramesPerChunk, [&](std::size_t begin, std::size_t end) {
    Silhouette::Projection projection;
    for (std::size_t i = begin; i < end; ++i)
      shrink_frame(frames[i], times, kSmaller, shape, projection);
  });
}

BoxFrame found_box(const Silhouette& shape, const std::vector<Eigen::Matrix3d>& starts, const Effort& effort,
                   const FitExecution& execution) {
  constexpr int kRotations = 3, kLastRotations = 90;
  std::vector<BoxFrame> frames;
  frames.reserve(starts.size());
  for (const Eigen::Matrix3d& axes : starts)
    frames.push_back({axes, extents(shape.vertices(), axes)});
  const std::vector<BoxFrame> guaranteed(frames.begin(), frames.begin() + kGuaranteedStarts);
  const auto smaller = [](const BoxFrame& a, const BoxFrame& b) { return a.volume() < b.volume(); };
  const auto keep = [&](std::size_t count) {
    std::stable_sort(frames.begin(), frames.end(), smaller);
    frames.resize(std::min(count, frames.size()));
  };
  keep(effort.rotated_starts);
  while (frames.size() > effort.finalists) {
    shrink_all(frames, kRotations, shape, execution);
    keep(std::max(effort.finalists, frames.size() / 2));
  }
  shrink_all(frames, kLastRotations, shape, execution);
  BoxFrame best = *std::min_element(frames.begin(), frames.end(), smaller);
  best.size = extents(shape.vertices(), best.axes);  // without the rounding errors of silhouettes
  const BoxFrame& best_guaranteed = *std::min_element(guaranteed.begin(), guaranteed.end(), smaller);
  return smaller(best_guaranteed, best) ? best_guaranteed : best;
}

Eigen::Matrix3d solid_axes(const PointView& points, const Summary& summary, const LocalFrame& frame,
                           const LocalHull& hull, const FitExecution& execution) {
  const Silhouette shape(hull.local_vertices(), hull.triangles);
  const bool pairs = shape.vertices().size() <= kExhaustive;
  const Effort& effort = pairs ? kBeforePairs : kSearch;
  BoxFrame box = found_box(shape, start_frames(points, summary, frame, hull, effort), effort, execution);
  if (pairs) box = smallest_box(box, shape);
  return orthonormal_axes(box.axes);
}

}  // namespace

Eigen::Matrix3d minimal_axes(const PointView& points, const Summary& summary, const LocalFrame& frame,
                             const FitExecution& execution) {
  if (!(frame.extent() > 0)) return Eigen::Matrix3d::Identity();
  const std::shared_ptr<const LocalHull> shared = shared_hull(points, summary.supports, frame, execution);
  const LocalHull& hull = *shared;
  if (hull.rank < 2) return orthonormal_axes(hull.axes);
  if (hull.rank == 2) return flat_axes(hull);
  return solid_axes(points, summary, frame, hull, execution);
}

}  // namespace pcl_bv::detail
