// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Samples a few thousand points of the cloud, runs RANSAC with a cost that penalises points below the plane,
// and refines the plane by least squares.
#include "plane_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "cloud_sample.h"
#include "up_frame.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr std::size_t cells_per_side = 32;
constexpr std::size_t points_per_cell = 4;

struct Spread {
  double low, middle, high;
};

// Returns the median along an axis, and limits that a few outliers do not change.
Spread spread_of(const std::vector<Vector3d>& sample, const Vector3d& axis) {
  std::array<double, 1024> values;
  const std::size_t n = std::min(sample.size(), values.size());
  for (std::size_t i = 0; i < n; ++i)
    values[i] = dot3(sample[i], axis);
  const auto begin = values.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(n);
  const auto tail = static_cast<std::ptrdiff_t>(n / 50);
  const auto middle = begin + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(begin, middle, end);
  std::nth_element(begin, begin + tail, middle);
  std::nth_element(middle, end - 1 - tail, end);
  const double low = *(begin + tail);
  const double high = *(end - 1 - tail);
  const double margin = 0.5 * (high - low);
  return {low - margin, *middle, high + margin};
}

// Returns the row or column of a value. Values outside the grid are in the outermost rows and columns.
std::size_t grid_line(double value, const Spread& spread) {
  if (!(spread.high > spread.low)) return 0;
  const double line = (value - spread.low) / (spread.high - spread.low) * cells_per_side;
  return static_cast<std::size_t>(std::clamp(line, 0.0, cells_per_side - 1.0));
}

struct Cell {
  std::size_t count = 0;
  std::size_t lowest = 0;  // position of its lowest point in GroundScratch::lowest
};

// Adds a point to its cell. Only the first points_per_cell points of a cell are added to scratch.support.
void add(const Vector3d& p, const Vector3d& upward, Cell& cell, GroundScratch& scratch) {
  if (cell.count < points_per_cell) scratch.support.push_back(p);
  if (cell.count == 0) {
    cell.lowest = scratch.lowest.size();
    scratch.lowest.push_back(p);
  } else if (dot3(p, upward) < dot3(scratch.lowest[cell.lowest], upward)) {
    scratch.lowest[cell.lowest] = p;
  }
  ++cell.count;
}

// Fills the buffers of `scratch` with points relative to the returned position. This position is in the
// middle of the cloud, so that UTM coordinates lose no precision. Without valid points all buffers are empty.
// - `sample` has at most `sample_size` points, evenly spread over the point indices.
// - `support` has at most 4096 points of the sample, evenly spread over the area seen from above.
// - `lowest` has the lowest point of each of at most 1024 cells of this area.
Vector3d sample_ground(const PointView& points, const UpFrame& frame, std::uint32_t seed,
                       std::size_t sample_size, GroundScratch& scratch) {
  constexpr std::size_t cells = cells_per_side * cells_per_side;
  scratch.support.clear();
  scratch.support.reserve(cells * points_per_cell);
  scratch.lowest.clear();
  scratch.lowest.reserve(cells);
  draw_sample(points, seed, sample_size, scratch.sample);
  if (scratch.sample.empty()) return Vector3d::Zero();

  const Vector3d vertical = cross3(frame.u, frame.v);
  const Spread u = spread_of(scratch.sample, frame.u), v = spread_of(scratch.sample, frame.v);
  Vector3d origin =
      (u.middle * frame.u + v.middle * frame.v) + spread_of(scratch.sample, vertical).middle * vertical;
  std::array<Cell, cells> grid{};
  for (Vector3d& p : scratch.sample) {
    Cell& cell = grid[grid_line(dot3(p, frame.u), u) * cells_per_side + grid_line(dot3(p, frame.v), v)];
    p -= origin;
    add(p, frame.up, cell, scratch);
  }
  return origin;
}

constexpr double max_above = 1;
constexpr double max_below = 2;
constexpr unsigned refinements = 3;

// Smallest ratio of the second largest width of points to the largest width. Points with a smaller ratio are
// treated as a line, which determines no plane.
constexpr double min_width_ratio = 0.02;

Vector3d normalized(const Vector3d& v) {
  const double norm2 = dot3(v, v);
  return norm2 > 0 ? Vector3d(v / std::sqrt(norm2)) : v;
}

// The limits that a plane must satisfy.
struct Limits {
  Vector3d up;
  double min_cosine;
  Vector3d sensor;
  std::optional<double> sensor_height;

  bool allow(const Plane& plane) const {
    const double cosine = dot3(plane.normal, up);
    if (!(cosine >= min_cosine)) return false;
    return !sensor_height ||
           std::abs(height_above(plane, sensor) / cosine - *sensor_height) <= ground_height_tolerance;
  }
};

// Returns the plane through `point` with its normal pointing up.
Plane plane_at(const Vector3d& point, const Vector3d& unit_normal, const Vector3d& up) {
  const Vector3d normal = dot3(unit_normal, up) < 0 ? Vector3d(-unit_normal) : unit_normal;
  return {normal, dot3(normal, point)};
}

std::optional<Plane> plane_through(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                   const Limits& limits) {
  const Vector3d normal =
      normalized(normalized(b - a).cross(normalized(c - a)));  // zero for points on a line, so not allowed
  const Plane plane = plane_at(a, normal, limits.up);
  if (!limits.allow(plane)) return {};
  return plane;
}

// Returns the sum, over all points, of the squared height above the plane. Heights are in units of `distance`
// and clamped to the range from -max_below to max_above. Stops early when the sum is no longer below `best`.
// Eigen's min and max do not branch. Branches would be three times slower, because heights are unpredictable.
// Each of the four lanes is summed in order, so the bits do not depend on the SIMD width.
double cost_of(const Plane& plane, const Points& points, double distance, double best) {
  using Lanes = Eigen::Array4d;
  constexpr std::size_t groups = 16;
  const Vector3d normal = plane.normal / distance;
  const double offset = plane.offset / distance;
  double cost = 0;
  for (std::size_t begin = 0; begin < points.size() && cost < best; begin += 4 * groups) {
    const std::size_t n = std::min(4 * groups, points.size() - begin);
    std::array<double, 4 * groups> heights{};
    for (std::size_t i = 0; i < n; ++i)
      heights[i] = dot3(normal, points[begin + i]) - offset;
    Lanes sums = Lanes::Zero();
    for (std::size_t i = 0; i < 4 * groups; i += 4)
      sums += Eigen::Map<const Lanes>(heights.data() + i).min(max_above).max(-max_below).square();
    cost += (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }
  return cost;
}

// Returns the least-squares plane of the points within `distance` of `plane`.
std::optional<Plane> refine(const Plane& plane, const Points& points, double distance, const Limits& limits) {
  const auto near = [&](const Vector3d& p) { return std::abs(height_above(plane, p)) <= distance; };
  Vector3d sum = Vector3d::Zero();
  double count = 0;
  for (const Vector3d& p : points) {
    if (!near(p)) continue;
    sum += p;
    ++count;
  }
  if (count < 3) return {};
  const Vector3d mean = sum / count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : points) {
    if (near(p)) scatter += (p - mean) * (p - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Vector3d& widths2 = solver.eigenvalues();
  if (!(widths2[1] >= min_width_ratio * min_width_ratio * widths2[2])) return {};
  const Plane refined = plane_at(mean, solver.eigenvectors().col(0), limits.up);
  if (!limits.allow(refined)) return {};
  return refined;
}

// Returns the plane with the smallest cost that passes through three points of points.lowest. `lowest` has
// ground points even where tables hide most of the ground.
std::optional<Plane> search(const GroundScratch& points, const Limits& limits,
                            const GroundPlaneOptions& options) {
  const Points& lowest = points.lowest;
  if (lowest.size() < 3) return {};
  std::mt19937 random(options.seed);  // the standard fixes the numbers of mt19937
  const auto pick = [&]() -> const Vector3d& {
    return lowest[static_cast<std::size_t>(std::uint64_t{random()} * lowest.size() >> 32)];
  };
  std::optional<Plane> best;
  // Start with the cost of a plane far below all points.
  double best_cost = max_above * max_above * static_cast<double>(points.support.size());
  for (unsigned i = 0; i < options.iterations; ++i) {
    const Vector3d& a = pick();
    const Vector3d& b = pick();
    const Vector3d& c = pick();
    const std::optional<Plane> plane = plane_through(a, b, c, limits);
    if (!plane) continue;
    const double cost = cost_of(*plane, points.support, options.distance, best_cost);
    if (!(cost < best_cost)) continue;
    best = plane;
    best_cost = cost;
  }
  return best;
}

}  // namespace

std::optional<Plane> find_ground_plane(const PointView& points, const Vector3d& sensor,
                                       const GroundPlaneOptions& options, GroundScratch& scratch,
                                       std::size_t sample_size) {
  const UpFrame frame(options.up);
  const Vector3d origin = sample_ground(points, frame, options.seed, sample_size, scratch);
  const Limits limits{frame.up, std::cos(options.max_slope_degrees * std::numbers::pi / 180), sensor - origin,
                      options.sensor_height};
  std::optional<Plane> best = search(scratch, limits, options);
  // The search weights points by area, so its plane fits a few distant points as well as many near points.
  // Least squares over the whole sample moves the plane towards the near points, which are most points. There
  // is no result if the limits allow the plane of the search but not the refined plane, e.g. on a strip of a
  // wall.
  for (unsigned i = 0; best && i < refinements; ++i)
    best = refine(*best, scratch.sample, options.distance, limits);
  if (best) best->offset += dot3(best->normal, origin);
  return best;
}

}  // namespace pcl_bv::detail
