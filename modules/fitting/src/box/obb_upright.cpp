// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Upright boxes, either of minimum area or with the sides closest to the points (Zhang et al. 2017).

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "box/obb_axes.h"
#include "box/outline.h"
#include "box/rectangle.h"
#include "pcl_bv/numeric/constants.h"
#include "same_points.h"

namespace pcl_bv::detail {
namespace {

// Returns the unit vector at t. From t = 0 to t = 1 the vector rotates by 90 degrees. It is computed without
// a sine, because libraries round the sine differently.
Eigen::Vector2d direction(double t) {
  const double x = 1 - t, length = std::sqrt(x * x + t * t);
  return {x / length, t / length};
}

constexpr std::size_t kCoarseSteps = 20;  // steps of 3 to 6 degrees
constexpr std::size_t kCoarsePoints = 512;
constexpr std::size_t kFinePoints = 4096;
constexpr int kStarts = 3;
constexpr int kHalvings = 7;  // The last steps are of 0.02 to 0.05 degrees.

// Distances of points from a side are treated as equal if they are below this fraction of the rectangle's
// diagonal. For a car this limit is 12 cm.
constexpr double kNear = 1.0 / 40;

// An evenly spaced sample of the cloud seen from above. Floats are precise enough, because the sample is only
// used to choose an angle.
struct Sample {
  Sample(const PointView& points, const Supports& supports, const LocalFrame& frame, const Ground& ground,
         const Eigen::Vector2d& origin, std::size_t size) {
    const std::size_t step = std::max<std::size_t>(1, (points.count + size - 1) / size);
    for (std::size_t i = 0; i < points.count; i += step) {
      const Coordinates p = load_point(LoadedPoints(points, i, 1).view(), 0);
      if (!is_valid(p)) continue;
      require_same_points(within(supports, p));
      const Eigen::Vector2d at = ground.flat(frame.local(p)) - origin;
      x.push_back(static_cast<float>(at.x()));
      y.push_back(static_cast<float>(at.y()));
    }
  }

  std::vector<float> x, y;
};

// Measures how close the points are to the sides of a rectangle. The closeness is the sum of
// 1 / max(d, near)^2 over the points, where d is the distance of a point from the nearest side.
class Closeness {
 public:
  Closeness(const Outline& outline, double diagonal)
      : outline_(outline),
        origin_(outline[0]),
        near_(static_cast<float>((diagonal * kNear) * (diagonal * kNear))) {}

  double operator()(const Sample& sample, const Eigen::Vector2d& side) const {
    const Sides sides = sides_along(side);
    using Lanes = Eigen::Array<float, 8, 1>;
    const auto term = [&](const auto& x, const auto& y) -> Lanes {
      const Lanes u = sides.x * x + sides.y * y, v = sides.x * y - sides.y * x;
      const Lanes across = (u - sides.left).min(sides.right - u),
                  along = (v - sides.bottom).min(sides.top - v);
      const Lanes d = across.min(along);
      return (d * d).max(near_).inverse();
    };
    Lanes sum = Lanes::Zero();
    const std::size_t whole = sample.x.size() / 8 * 8;
    for (std::size_t i = 0; i < whole; i += 8)
      sum += term(Eigen::Map<const Lanes>(&sample.x[i]), Eigen::Map<const Lanes>(&sample.y[i]));
    double total = 0;
    for (const float s : sum)
      total += s;
    for (std::size_t i = whole; i < sample.x.size(); ++i)
      total += term(Lanes::Constant(sample.x[i]), Lanes::Constant(sample.y[i]))[0];
    return total;
  }

 private:
  struct Sides {
    float x, y, left, right, bottom, top;
  };

  Sides sides_along(const Eigen::Vector2d& side) const {
    double left = kInfinity, right = -kInfinity, bottom = kInfinity, top = -kInfinity;
    for (const Eigen::Vector2d& corner : outline_) {
      const Eigen::Vector2d p = corner - origin_;
      const double u = side.x() * p.x() + side.y() * p.y(), v = side.x() * p.y() - side.y() * p.x();
      left = std::min(left, u);
      right = std::max(right, u);
      bottom = std::min(bottom, v);
      top = std::max(top, v);
    }
    const auto f = [](double d) { return static_cast<float>(d); };
    return {f(side.x()), f(side.y()), f(left), f(right), f(bottom), f(top)};
  }

  const Outline& outline_;
  Eigen::Vector2d origin_;
  float near_;
};

// A candidate angle, as the t of direction(), with its closeness.
struct AngleScore {
  double t;
  double closeness;
};

// Refines an angle by smaller and smaller steps to both sides. A step is taken if it increases the closeness.
AngleScore refined(AngleScore best, const Closeness& closeness, const Sample& sample) {
  best.closeness = closeness(sample, direction(best.t));
  double step = 0.5 / static_cast<double>(kCoarseSteps);
  for (int halving = 0; halving < kHalvings; ++halving, step /= 2) {
    const double middle = best.t;
    for (const double shifted : {middle - step, middle + step}) {
      const double t = shifted < 0 ? shifted + 1 : shifted >= 1 ? shifted - 1 : shifted;
      const double value = closeness(sample, direction(t));
      if (value > best.closeness) best = {t, value};
    }
  }
  return best;
}

}  // namespace

Eigen::Matrix3d yaw_axes(const PointView& points, const Supports& supports, const LocalFrame& frame,
                         const Eigen::Vector3d& up, const FitExecution& execution) {
  const Ground ground(up);
  const Outline outline = outline_from_above(points, supports, frame, ground, execution);
  return ground.axes_along(smallest_rectangle(outline.data(), outline.size()).side);
}

Eigen::Matrix3d lshape_axes(const PointView& points, const Supports& supports, const LocalFrame& frame,
                            const Eigen::Vector3d& up, const FitExecution& execution) {
  const Ground ground(up);
  const Outline outline = outline_from_above(points, supports, frame, ground, execution);
  const Rectangle rectangle = smallest_rectangle(outline.data(), outline.size());
  if (outline.size() < 3) return ground.axes_along(rectangle.side);
  const Closeness closeness(outline, rectangle.diagonal());
  const Sample coarse(points, supports, frame, ground, outline[0], kCoarsePoints);
  std::array<AngleScore, kCoarseSteps> scores;
  for (std::size_t k = 0; k < kCoarseSteps; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(kCoarseSteps);
    scores[k] = {t, closeness(coarse, direction(t))};
  }
  std::stable_sort(scores.begin(), scores.end(),
                   [](const AngleScore& a, const AngleScore& b) { return a.closeness > b.closeness; });
  const Sample fine(points, supports, frame, ground, outline[0], kFinePoints);
  AngleScore best{0, -1};
  for (std::size_t k = 0; k < kStarts; ++k) {
    const AngleScore score = refined(scores[k], closeness, fine);
    if (score.closeness > best.closeness) best = score;
  }
  return ground.axes_along(direction(best.t));
}

}  // namespace pcl_bv::detail
