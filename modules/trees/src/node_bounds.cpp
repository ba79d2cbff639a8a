// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The terms of all sums in this file are below a few times 1 + |point|, in double, so the errors of the sums
// are below 2^-45 (1 + |point|). This is negligible against the margin of 2^-20 (1 + |point|), so no bound
// adds another margin for it.

#include "node_bounds.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "support_bounds.h"
#include "vectors.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kSlabs = 7;

// Clips [enter, exit] to the t with low <= start + t slope <= high.
void clip(double start, double slope, double low, double high, double& enter, double& exit) {
  if (slope == 0) {
    if (start < low || start > high) exit = -kInfinity;
    return;
  }
  const double a = (low - start) / slope, b = (high - start) / slope;
  enter = std::max(enter, std::min(a, b));
  exit = std::min(exit, std::max(a, b));
}

// Returns the t >= 0 at which the ray enters, or infinity if the interval has no t >= 0. The margin covers
// the error of the interval by underflow in intersect().
double entered(const FrameRay& ray, double enter, double exit) {
  return enter - ray.underflow_margin <= exit + ray.underflow_margin
             ? std::max(0.0, enter - ray.underflow_margin)
             : kInfinity;
}

}  // namespace

FramePoint::FramePoint(const VolumeBoxes& boxes, const Coordinates& point) {
  at = (vector(point) - vector(boxes.levels().origin)) * boxes.levels().scale;
  margin = VolumeBoxes::margin(at.cwiseAbs().maxCoeff());
}

FrameRay::FrameRay(const VolumeBoxes& boxes, const Coordinates& origin, const Coordinates& direction)
    : from(boxes, origin) {
  const int length = std::ilogb(vector(direction).cwiseAbs().maxCoeff());
  u = vector(direction).unaryExpr([&](double x) { return std::ldexp(x, -length); });
  exponent = length + std::ilogb(boxes.levels().scale);
  underflow_margin = std::ldexp(0x1p-1020, exponent);
}

double FrameRay::time(double t) const {
  return std::ldexp(t, exponent);
}

double distance_to_box(const FramePoint& point, const BoxGroup& group, std::size_t k) {
  double squares = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = point.at[axis],
                 gap = std::max(0.0, std::max(group.low[axis][k] - at, at - group.high[axis][k]));
    squares += gap * gap;
  }
  return std::max(0.0, std::sqrt(squares) - 2 * point.margin);
}

double enter_box(const FrameRay& ray, const BoxGroup& group, std::size_t k) {
  if (group.low[0][k] > group.high[0][k]) return kInfinity;  // empty
  double enter = 0, exit = kInfinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    clip(ray.from.at[axis], ray.u[axis], group.low[axis][k] - ray.from.margin,
         group.high[axis][k] + ray.from.margin, enter, exit);
  }
  return entered(ray, enter, exit);
}

template <typename Shape, typename Item, typename Join>
void NodeShapes::fill(std::vector<Shape>& shapes, const BoxLevels& levels, const ParallelPolicy& policy,
                      const Item& item, const Join& join) {
  shapes.assign(levels.groups.size() * kTreeWidth, Shape());
  for_each_range(policy, levels.child_counts[0], kVolumesOfChunk, [&](std::size_t begin, std::size_t end) {
    const FloatEnvironment environment;
    for (std::size_t i = begin; i < end; ++i)
      shapes[i] = item(i);
  });
  for (std::size_t level = 1; level < levels.levels; ++level) {
    for (std::size_t i = 0; i < levels.child_counts[level]; ++i) {
      const Shape* const below = shapes.data() + (levels.first[level - 1] + i) * kTreeWidth;
      shapes[levels.first[level] * kTreeWidth + i] = join(below, kTreeWidth);
    }
  }
}

void NodeShapes::measure(NodeBounds kind, const VolumeBoxes& boxes, const std::vector<AnyVolume>& volumes,
                         const ParallelPolicy& policy) {
  const auto has_box = [&](std::size_t item) {
    const BoxGroup& group = boxes.levels().groups[item / kTreeWidth];
    return group.low[0][item % kTreeWidth] <= group.high[0][item % kTreeWidth];
  };
  if (kind == NodeBounds::dop14) {
    fill(
        slabs_, boxes.levels(), policy,
        [&](std::size_t item) {
          return has_box(item) ? slabs_of(boxes, volumes[boxes.volume_index(item)]) : Slabs();
        },
        [](const Slabs* slabs, std::size_t count) {
          Slabs all;
          for (std::size_t k = 0; k < count; ++k)
            all.merge(slabs[k]);
          return all;
        });
  } else if (kind == NodeBounds::sphere) {
    fill(
        balls_, boxes.levels(), policy,
        [&](std::size_t item) {
          return has_box(item) ? ball_of(boxes, volumes[boxes.volume_index(item)]) : Ball();
        },
        [](const Ball* balls, std::size_t count) { return joined(balls, count); });
  }
}

NodeShapes::Slabs NodeShapes::slabs_of(const VolumeBoxes& boxes, const AnyVolume& volume) {
  const double scale = boxes.levels().scale;
  Slabs slabs;
  slabs.min.fill(-std::numeric_limits<float>::infinity());
  slabs.max.fill(std::numeric_limits<float>::infinity());
  const Aabb box = aabb(volume);
  if (box.empty()) return slabs;  // a k-DOP whose slabs have no common point
  const SlabBounds<kSlabs, double> bounds(volume);
  const double margin = 2 * contains_margin(box);
  for (std::size_t i = 3; i < kSlabs; ++i) {  // the box bounds the first three
    Expansion low, high;
    low.add_dot(-cube_vector(i), boxes.levels().origin);
    high = low;
    slabs.max[i] = float_up(multiply_up(high.add(bounds.max[i]).add(margin).up(), scale));
    slabs.min[i] = float_down(-multiply_up(-low.add(bounds.min[i]).add(-margin).down(), scale));
  }
  return slabs;
}

NodeShapes::Ball NodeShapes::ball_of(const VolumeBoxes& boxes, const AnyVolume& volume) {
  const PositionBounds extent = extent_of(volume);
  const Eigen::Vector3d size = vector(extent.high) - vector(extent.low);
  double radius = 0.5 * norm3(size);
  Eigen::Vector3d center = 0.5 * vector(extent.low) + 0.5 * vector(extent.high);
  if (const auto* const sphere = std::get_if<Sphere>(&volume)) {
    radius = sphere->radius() + contains_margin(sphere->aabb());
    center = sphere->center();
  }
  Ball ball;
  ball.center = FramePoint(boxes, coordinates(center)).at.cast<float>();
  ball.radius =
      float_up(radius * boxes.levels().scale * (1 + 0x1p-20) + 0x1p-20);  // errors of radius and centre
  return ball;
}

NodeShapes::Ball NodeShapes::joined(const Ball* balls, std::size_t count) {
  Eigen::Array3d low = Eigen::Array3d::Constant(kInfinity), high = -low;
  for (const Ball& ball : std::span(balls, count)) {
    low = low.min(ball.center.cast<double>().array() - ball.radius);
    high = high.max(ball.center.cast<double>().array() + ball.radius);
  }
  Ball all;
  if (!low.allFinite()) return all;
  all.center = (0.5 * (low + high)).matrix().cast<float>();
  double radius = 0;
  for (const Ball& ball : std::span(balls, count))
    radius = std::max(
        radius, norm3(Eigen::Vector3d(ball.center.cast<double>() - all.center.cast<double>())) + ball.radius);
  all.radius = float_up(radius);
  return all;
}

double NodeShapes::distance(std::size_t shape, const FramePoint& point) const {
  double farthest = 0;
  if (!slabs_.empty()) {
    const Slabs& slabs = slabs_[shape];
    for (std::size_t i = 3; i < kSlabs; ++i) {
      const double s = dot3(cube_vector(i), point.at);
      farthest = std::max(farthest, std::max(slabs.min[i] - s, s - slabs.max[i]) / 1.7320508075688774);
    }
  } else if (!balls_.empty()) {
    const Ball& ball = balls_[shape];
    farthest = norm3(Eigen::Vector3d(point.at - ball.center.cast<double>())) - ball.radius;
  }
  return std::max(0.0, farthest - 2 * point.margin);
}

std::uint32_t NodeShapes::may_contain(std::size_t group, std::uint32_t bits, const FramePoint& point) const {
  std::uint32_t found = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int k = std::countr_zero(bits);
    if (distance(group * kTreeWidth + static_cast<std::size_t>(k), point) <= 0) found |= 1U << k;
  }
  return found;
}

double NodeShapes::enter(std::size_t shape, const FrameRay& ray) const {
  double enter = 0, exit = kInfinity;
  if (!slabs_.empty()) {
    const Slabs& slabs = slabs_[shape];
    if (slabs.min[3] > slabs.max[3]) return kInfinity;
    for (std::size_t i = 3; i < kSlabs; ++i) {
      const Eigen::Vector3d d = cube_vector(i);
      clip(dot3(d, ray.from.at), dot3(d, ray.u), slabs.min[i] - 4 * ray.from.margin,
           slabs.max[i] + 4 * ray.from.margin, enter, exit);
    }
  } else if (!balls_.empty()) {
    const Ball& ball = balls_[shape];
    if (ball.radius < 0) return kInfinity;
    const Eigen::Vector3d q = ball.center.cast<double>() - ray.from.at;
    const double radius = ball.radius + 4 * ray.from.margin, uu = dot3(ray.u, ray.u),
                 nearest = dot3(q, ray.u) / uu;
    // The error of min_square is below 2^-48 |q|^2, so radius covers it: (4 margin)^2 is at least 2^-38
    // |q|^2.
    const double min_square = dot3(q, q) - nearest * nearest * uu;
    const double half = radius * radius - min_square;
    if (half < 0) return kInfinity;
    const double half_length = std::sqrt(half / uu);
    enter = std::max(0.0, nearest - half_length);
    exit = nearest + half_length;
  }
  return entered(ray, enter, exit);
}

}  // namespace pcl_bv
