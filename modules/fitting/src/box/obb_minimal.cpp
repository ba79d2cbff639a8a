// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The smallest box: there are exact algorithms, cubic in the hull's vertices. What comes within a few
// ten-thousandths of them is to start from many frames and to turn each about one of its axes after the other
// as far as the volume sinks: then the box around the outline along that axis is a matter of calipers
// (Barequet, Har-Peled 2001; Chang et al. 2011). Frames that fall behind are given up, half of them at a time
// (Karnin, Koren, Somekh 2013).

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <vector>

#include "box/flat_box.h"
#include "box/obb_axes.h"
#include "box/silhouette.h"
#include "hull/local_hull.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "schedule.h"

namespace pcl_bv {
namespace {

using Vertices = std::vector<Eigen::Vector3d>;

// A frame on its way to a smaller box.
struct Frame {
  Eigen::Matrix3d axes;
  Eigen::Vector3d size;  // along them
  int axis = 0;          // about which it is turned next
  int in_vain = 0;       // turns since the last that made the box smaller

  double volume() const { return size.prod(); }
  bool done() const { return in_vain == 3; }
};

Eigen::Vector3d extents(const Vertices& vertices, const Eigen::Matrix3d& axes) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(kInfinity), high = -low;
  for (const Eigen::Vector3d& p : vertices) {
    for (int i = 0; i < 3; ++i) {
      const double along = dot3(axes.col(i), p);
      low[i] = std::min(low[i], along);
      high[i] = std::max(high[i], along);
    }
  }
  return high - low;
}

// Turns the frame about its axes, so many times or until none of the three makes the box smaller.
void turn(Frame& frame, int times, const Silhouette& shape, Silhouette::View& view) {
  constexpr double kSmaller = 1 - 1e-9;  // less is not worth another round
  for (; times > 0 && !frame.done(); --times) {
    const int b = (frame.axis + 1) % 3, c = (frame.axis + 2) % 3;
    frame.axis = b;
    const Eigen::Vector3d u = frame.axes.col(b), v = frame.axes.col(c);
    const std::vector<Eigen::Vector2d>& corners = shape.look(u, v, view);
    const FlatBox box = least_rectangle(corners.data(), corners.size());
    if (!(box.area() < frame.size[b] * frame.size[c] * kSmaller)) {
      ++frame.in_vain;
      continue;
    }
    frame.axes.col(b) = box.side.x() * u + box.side.y() * v;
    frame.axes.col(c) = box.side.x() * v - box.side.y() * u;
    frame.size[b] = box.width;
    frame.size[c] = box.height;
    frame.in_vain = 1;  // about this axis it cannot get better
  }
}

// From the unit quaternions of seeded integers: the same on every machine.
std::vector<Eigen::Matrix3d> scattered_frames(std::size_t count) {
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

// Normals of the greatest facets.
void add_facets(const LocalHull& hull, std::vector<Eigen::Matrix3d>& frames) {
  constexpr std::size_t kFacets = 20;
  constexpr double kNoNormal = 1e-20;  // squared: of what is rounding alone
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

// The first of the starts: what the box must not be greater than.
constexpr std::size_t kSureStarts = 3;

std::vector<Eigen::Matrix3d> start_frames(const PointView& points, const CloudSummary& summary,
                                          const LocalFrame& frame, const LocalHull& hull) {
  Supports supports = summary.supports;
  supports.set = DirectionSet::dop14;  // whose directions come first
  static const std::vector<Eigen::Matrix3d> scattered = scattered_frames(60);
  std::vector<Eigen::Matrix3d> frames{dito_axes(few_points(points, supports, frame), supports, frame),
                                      principal_axes(summary), Eigen::Matrix3d::Identity()};
  add_facets(hull, frames);
  frames.insert(frames.end(), scattered.begin(), scattered.end());
  return frames;
}

Eigen::Matrix3d flat_axes(const LocalHull& hull) {
  std::vector<Eigen::Vector2d> flat;
  const Eigen::Vector3d u = hull.axes.col(0), v = hull.axes.col(1);
  for (const HullPoint& vertex : hull.vertices)
    flat.emplace_back(u.dot(vertex.local), v.dot(vertex.local));
  const Eigen::Vector2d side = least_rectangle(flat.data(), to_convex_chain(flat.data(), flat.size())).side;
  Eigen::Matrix3d axes;
  axes << hull.axes.col(2), side.x() * u + side.y() * v, Eigen::Vector3d::Zero();
  return orthonormal_axes(axes);
}

void turn_all(std::vector<Frame>& frames, int times, const Silhouette& shape, const Execution& execution) {
  constexpr std::size_t kFramesPerChunk = 4;
  const std::size_t looks = frames.size() * static_cast<std::size_t>(times) * shape.vertices().size();
  const ParallelPolicy policy = worthwhile(execution, Work::look, looks);
  for_each_run(policy, frames.size(), kFramesPerChunk, [&](std::size_t begin, std::size_t end) {
    const FloatEnvironment environment;
    Silhouette::View view;
    for (std::size_t i = begin; i < end; ++i)
      turn(frames[i], times, shape, view);
  });
}

Eigen::Matrix3d solid_axes(const LocalHull& hull, const std::vector<Eigen::Matrix3d>& starts,
                           const Execution& execution) {
  constexpr std::size_t kBeginners = 40, kFinalists = 8;
  constexpr int kTurns = 3, kLastTurns = 90;
  const Silhouette shape(hull.local_vertices(), hull.triangles);
  std::vector<Frame> frames;
  frames.reserve(starts.size());
  for (const Eigen::Matrix3d& axes : starts)
    frames.push_back({axes, extents(shape.vertices(), axes)});
  const std::vector<Frame> sure(frames.begin(), frames.begin() + kSureStarts);
  const auto smaller = [](const Frame& a, const Frame& b) { return a.volume() < b.volume(); };
  const auto keep = [&](std::size_t count) {
    std::stable_sort(frames.begin(), frames.end(), smaller);
    frames.resize(std::min(count, frames.size()));
  };
  keep(kBeginners);
  while (frames.size() > kFinalists) {
    turn_all(frames, kTurns, shape, execution);
    keep(std::max(kFinalists, frames.size() / 2));
  }
  turn_all(frames, kLastTurns, shape, execution);
  Frame best = *std::min_element(frames.begin(), frames.end(), smaller);
  best.size = extents(shape.vertices(), best.axes);  // without the rounding of rims
  const Frame& surest = *std::min_element(sure.begin(), sure.end(), smaller);
  return orthonormal_axes(smaller(surest, best) ? surest.axes : best.axes);
}

}  // namespace

Eigen::Matrix3d minimal_axes(const PointView& points, const CloudSummary& summary, const LocalFrame& frame,
                             const Execution& execution) {
  if (!(frame.extent() > 0)) return Eigen::Matrix3d::Identity();
  const std::shared_ptr<const LocalHull> shared = shared_hull(points, summary.supports, frame, execution);
  const LocalHull& hull = *shared;
  if (hull.rank < 2) return orthonormal_axes(hull.axes);
  if (hull.rank == 2) return flat_axes(hull);
  return solid_axes(hull, start_frames(points, summary, frame, hull), execution);
}

}  // namespace pcl_bv
