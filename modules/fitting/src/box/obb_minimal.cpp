// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The smallest box: there are exact algorithms, cubic in the hull's vertices. What comes within a few
// ten-thousandths of them is to start from many frames and to turn each about one of its axes after the other
// as far as the volume sinks: then the box around the outline along that axis is a matter of calipers
// (Barequet, Har-Peled 2001; Chang et al. 2011).

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "box/flat_box.h"
#include "box/obb_axes.h"
#include "hull/local_hull.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "scattered.h"
#include "schedule.h"

namespace pcl_bv {
namespace {

using Vertices = std::vector<Eigen::Vector3d>;

struct Frame {
  Eigen::Matrix3d axes;
  double volume;
};

Eigen::Vector3d extents(const Eigen::Vector3d* points, std::size_t count, const Eigen::Matrix3d& axes) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(kInfinity), high = -low;
  for (std::size_t n = 0; n < count; ++n) {
    const Eigen::Vector3d& p = points[n];
    for (int i = 0; i < 3; ++i) {
      const double along = dot3(axes.col(i), p);
      low[i] = std::min(low[i], along);
      high[i] = std::max(high[i], along);
    }
  }
  return high - low;
}

// Turns the frame about its axes in turn until none of the three makes the box smaller.
Frame turned(Eigen::Matrix3d axes, const Vertices& vertices) {
  constexpr int kMaxTurns = 100;
  constexpr double kSmaller = 1 - 1e-9;  // less is not worth another round
  std::vector<Eigen::Vector2d> flat(vertices.size());
  Eigen::Vector3d size = extents(vertices.data(), vertices.size(), axes);
  for (int turn = 0, in_vain = 0; turn < kMaxTurns && in_vain < 3; ++turn) {
    const int a = turn % 3, b = (a + 1) % 3, c = (a + 2) % 3;
    const Eigen::Vector3d u = axes.col(b), v = axes.col(c);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      flat[i] = {u.dot(vertices[i]), v.dot(vertices[i])};
    const FlatBox box = least_rectangle(flat.data(), to_convex_chain(flat.data(), flat.size()));
    if (!(box.area < size[b] * size[c] * kSmaller)) {
      ++in_vain;
      continue;
    }
    axes.col(b) = box.side.x() * u + box.side.y() * v;
    axes.col(c) = box.side.x() * v - box.side.y() * u;
    size = extents(vertices.data(), vertices.size(), axes);
    in_vain = 1;  // about this axis it cannot get better
  }
  return {axes, size.prod()};
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

// The best frames of an edge and the normal of a triangle, of all triangles of the few points.
void add_triangle_frames(const FewPoints& few, std::vector<Eigen::Matrix3d>& frames) {
  constexpr std::size_t kBest = 5;
  std::array<Frame, kBest> best;
  best.fill({Eigen::Matrix3d::Identity(), kInfinity});
  const auto compete = [&](const Eigen::Vector3d& edge, const Eigen::Vector3d& normal) {
    Frame frame{};
    frame.axes << edge, normal, edge.cross(normal);
    frame.volume = extents(few.data(), few.size(), frame.axes).prod();
    if (!(frame.volume < best.back().volume)) return;
    best.back() = frame;
    for (std::size_t i = kBest - 1; i > 0 && best[i].volume < best[i - 1].volume; --i)
      std::swap(best[i], best[i - 1]);
  };
  for (std::size_t i = 0; i < few.size(); ++i) {
    for (std::size_t j = i + 1; j < few.size(); ++j) {
      for (std::size_t k = j + 1; k < few.size(); ++k) {
        const Eigen::Vector3d normal = (few[j] - few[i]).cross(few[k] - few[i]);
        if (normal.squaredNorm() < 1e-20) continue;
        const Eigen::Vector3d n = normal.normalized();
        compete((few[j] - few[i]).normalized(), n);
        compete((few[k] - few[j]).normalized(), n);
        compete((few[i] - few[k]).normalized(), n);
      }
    }
  }
  for (const Frame& frame : best)
    if (frame.volume < kInfinity) frames.push_back(orthonormal_axes(frame.axes));
}

// The first of the starts: what the box must not be greater than.
constexpr std::size_t kSureStarts = 3;

std::vector<Eigen::Matrix3d> start_frames(const PointView& points, const CloudSummary& summary,
                                          const LocalFrame& frame) {
  Supports supports = summary.supports;
  supports.set = DirectionSet::dop14;  // whose directions come first
  const FewPoints few = few_points(points, supports, frame);
  static const std::vector<Eigen::Matrix3d> scattered = scattered_frames(40);
  std::vector<Eigen::Matrix3d> frames{dito_axes(few, supports, frame), principal_axes(summary),
                                      Eigen::Matrix3d::Identity()};
  add_triangle_frames(few, frames);
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

// Each start turned as far as it gets, best first.
std::vector<Frame> searched(const std::vector<Eigen::Matrix3d>& starts, const Vertices& vertices,
                            const Execution& execution) {
  std::vector<Frame> found(starts.size());
  const ParallelPolicy policy = worthwhile(execution, Work::box_turns, starts.size() * vertices.size());
  for_each_chunk(policy, starts.size(), [&](std::size_t i) {
    const FloatEnvironment environment;
    found[i] = turned(starts[i], vertices);
  });
  std::stable_sort(found.begin(), found.end(),
                   [](const Frame& a, const Frame& b) { return a.volume < b.volume; });
  return found;
}

std::vector<Eigen::Vector3d> axes_of(const std::vector<Eigen::Matrix3d>& frames) {
  std::vector<Eigen::Vector3d> axes;
  for (const Eigen::Matrix3d& frame : frames)
    axes.insert(axes.end(), {frame.col(0), frame.col(1), frame.col(2)});
  return axes;
}

// Many vertices are searched in two rounds: all starts on those that are farthest along scattered directions,
// what nearly all of the shape is made of, the best of them on all.
Eigen::Matrix3d solid_axes(const Vertices& vertices, std::vector<Eigen::Matrix3d> starts,
                           const Execution& execution) {
  constexpr std::size_t kManyVertices = 300, kFinalists = 6;
  if (vertices.size() > kManyVertices) {
    static const std::vector<Eigen::Vector3d> directions = axes_of(scattered_frames(60));
    const std::vector<Frame> found = searched(starts, farthest_along(directions, vertices), execution);
    starts.resize(kSureStarts);
    for (std::size_t i = 0; i < kFinalists; ++i)
      starts.push_back(found[i].axes);
  }
  return orthonormal_axes(searched(starts, vertices, execution).front().axes);
}

}  // namespace

Eigen::Matrix3d minimal_axes(const PointView& points, const CloudSummary& summary, const LocalFrame& frame,
                             const Execution& execution) {
  if (!(frame.extent() > 0)) return Eigen::Matrix3d::Identity();
  const std::shared_ptr<const LocalHull> shared = shared_hull(points, summary.supports, frame, execution);
  const LocalHull& hull = *shared;
  if (hull.rank < 2) return orthonormal_axes(hull.axes);
  if (hull.rank == 2) return flat_axes(hull);
  return solid_axes(hull.local_vertices(), start_frames(points, summary, frame), execution);
}

}  // namespace pcl_bv
