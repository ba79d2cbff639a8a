// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One pass over the points, in double.

#include "filter.h"

#include <limits>
#include <stdexcept>

namespace pcl_bv {

PointFilter::PointFilter(const FilterConfig& config)
    : min2_(config.range_min * config.range_min),
      max2_(config.range_max * config.range_max),
      boxed_(config.own_box_min.has_value()),
      low_(config.own_box_min.value_or(Eigen::Vector3d::Zero())),
      high_(config.own_box_max.value_or(Eigen::Vector3d::Zero())) {}

namespace {

template <typename T>
std::size_t filter_typed(const PointView& points, const PointFilter& filter, std::int32_t* kept,
                         Counts& counts) {
  std::size_t out_of_range = 0, invalid = 0, n = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    T p[3];
    load_point(points, i, p);
    const auto [valid, inside] = filter.judge(p);
    invalid += !valid;
    out_of_range += valid && !inside;
    kept[n] = static_cast<std::int32_t>(points.index(i));
    n += valid && inside;
  }
  counts.nonfinite = invalid;
  counts.range = out_of_range;
  return n;
}

}  // namespace

void filter_points(const PointView& points, const FilterConfig& config, std::vector<std::int32_t>& kept,
                   Counts& counts) {
  if (points.count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::length_error("more than 2147483647 points: too many to select from");
  kept.resize(points.count);
  const PointFilter filter(config);
  kept.resize(points.scalar == ScalarType::float64
                  ? filter_typed<double>(points, filter, kept.data(), counts)
                  : filter_typed<float>(points, filter, kept.data(), counts));
}

}  // namespace pcl_bv
