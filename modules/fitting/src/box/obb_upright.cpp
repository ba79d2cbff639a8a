// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Upright boxes, either of minimum area or with the sides closest to the points (Zhang et al. 2017). The
// angle of the latter is then fitted to the points near the sides by least squares.

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
constexpr int kHalvings = 4;  // The last steps are of 0.2 to 0.4 degrees.
constexpr int kFits = 3;
constexpr double kEnough = 0.95;  // the part of the closeness that a fit of the sides must retain

// Distances of points from a side are treated as equal if they are below this fraction of the rectangle's
// diagonal. For a car this limit is 12 cm. So all angles within 1.5 degrees are equally good for the sides of
// a car: fitted() chooses among them.
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

  // Returns the angle of the rectangle whose sides have the smallest sum of squared distances from the points
  // that are near the sides of the rectangle along `side`. Each point counts for its nearest side. The sides
  // may be moved, but stay parallel or perpendicular.
  Eigen::Vector2d fitted(const Sample& sample, const Eigen::Vector2d& side) const {
    const Sides sides = sides_along(side);
    std::array<Scatter, 4> of_side{};
    for (std::size_t i = 0; i < sample.x.size(); ++i) {
      const float x = sample.x[i], y = sample.y[i];
      const float u = sides.x * x + sides.y * y, v = sides.x * y - sides.y * x;
      const std::array<float, 4> d{u - sides.left, sides.right - u, v - sides.bottom, sides.top - v};
      const auto nearest = static_cast<std::size_t>(std::min_element(d.begin(), d.end()) - d.begin());
      if (d[nearest] * d[nearest] <= near_) of_side[nearest].add(x, y);
    }
    // The sum is a quadratic form of the unit vector, a x^2 + 2 b x y + c y^2.
    double a = 0, b = 0, c = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Scatter s = of_side[i].about_mean();
      a += i < 2 ? s.xx : s.yy;
      b += i < 2 ? s.xy : -s.xy;
      c += i < 2 ? s.yy : s.xx;
    }
    // It is smallest where twice the angle is opposite to (a - c, 2 b).
    const double length = std::sqrt((a - c) * (a - c) + 4 * b * b);
    if (!(length > 0)) return side;
    const double cos2 = (c - a) / length, sin2 = -2 * b / length;
    const double larger = std::sqrt((1 + std::abs(cos2)) / 2), smaller = sin2 / (2 * larger);
    return cos2 > 0 ? Eigen::Vector2d(larger, smaller) : Eigen::Vector2d(smaller, larger);
  }

 private:
  struct Sides {
    float x, y, left, right, bottom, top;
  };

  // Sums over points.
  struct Scatter {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

    void add(double px, double py) {
      n += 1;
      x += px;
      y += py;
      xx += px * px;
      xy += px * py;
      yy += py * py;
    }
    Scatter about_mean() const {
      if (n == 0) return {};
      return {n, 0, 0, xx - x * x / n, xy - x * y / n, yy - y * y / n};
    }
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

// Fits the sides to the points near them, again and again, since a point may come near or change its side.
Eigen::Vector2d fitted(Eigen::Vector2d side, double value, const Closeness& closeness, const Sample& sample) {
  for (int fit = 0; fit < kFits; ++fit) {
    const Eigen::Vector2d next = closeness.fitted(sample, side);
    if (!(closeness(sample, next) >= kEnough * value)) break;
    side = next;
  }
  return side;
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
  return ground.axes_along(fitted(direction(best.t), best.closeness, closeness, fine));
}

}  // namespace pcl_bv::detail
