// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One pass over the points, in double.

#include "filter.h"

#include <limits>
#include <stdexcept>

namespace pcl_bv {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Limits {
  double min2, max2;
  Eigen::Vector3d low, high;  // of the own box; low above high: none
};

Limits limits_of(const FilterConfig& config) {
  const Eigen::Vector3d one = Eigen::Vector3d::Ones();
  return {config.range_min * config.range_min, config.range_max * config.range_max,
          config.own_box_min.value_or(one), config.own_box_max.value_or(-one)};
}

// The square of a float is exact in double and the sum of three is rounded twice: a point is judged by its
// true distance to within 2e-16 of it.
template <typename T>
void filter_typed(const PointView& points, const Limits& limits, std::int32_t* kept, std::size_t& used,
                  Counts& counts) {
  const bool boxed = limits.low.x() <= limits.high.x();
  std::size_t out_of_range = 0, invalid = 0, n = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    T v[3];
    load_point(points, i, v);
    const double x = v[0], y = v[1], z = v[2];
    const double distance2 = (x * x + y * y) + z * z;
    // The squares of finite floats are finite in double: one comparison instead of three.
    const bool valid = sizeof(T) == 4 ? distance2 < kInfinity : is_valid({x, y, z});
    bool inside = distance2 >= limits.min2 && distance2 <= limits.max2;
    if (boxed) {
      inside = inside && !(x >= limits.low.x() && x <= limits.high.x() && y >= limits.low.y() &&
                           y <= limits.high.y() && z >= limits.low.z() && z <= limits.high.z());
    }
    invalid += !valid;
    out_of_range += valid && !inside;
    kept[n] = static_cast<std::int32_t>(points.index(i));
    n += valid && inside;
  }
  used = n;
  counts.nonfinite = invalid;
  counts.range = out_of_range;
}

}  // namespace

void filter_points(const PointView& points, const FilterConfig& config, std::vector<std::int32_t>& kept,
                   Counts& counts) {
  if (points.count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::length_error("more than 2147483647 points: too many to select from");
  kept.resize(points.count);
  std::size_t used = 0;
  const Limits limits = limits_of(config);
  if (points.scalar == ScalarType::float64) {
    filter_typed<double>(points, limits, kept.data(), used, counts);
  } else {
    filter_typed<float>(points, limits, kept.data(), used, counts);
  }
  kept.resize(used);
}

}  // namespace pcl_bv
