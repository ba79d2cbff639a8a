// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Neighbours are looked for along the longest side of the cloud, where its points are sorted: a search ends
// where that coordinate alone is farther away than the nearest point so far.

#include "info.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl_bv {
namespace {

std::vector<Eigen::Vector3d> collect_points(const PointView& view, CloudInfo& info) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(view.count);
  for (std::size_t i = 0; i < view.count; ++i) {
    const Coordinates p = load_point(view, i);
    if (!is_valid(p)) {
      ++info.nonfinite;
    } else if (p.x == 0 && p.y == 0 && p.z == 0) {
      ++info.zero;
    } else {
      points.emplace_back(p.x, p.y, p.z);
      info.box.extend(points.back());
    }
  }
  return points;
}

/// Distance from point i of the sorted ones to the nearest other.
double nearest(const std::vector<Eigen::Vector3d>& sorted, std::size_t i, Eigen::Index axis) {
  double best = std::numeric_limits<double>::infinity();
  const auto visit = [&](std::size_t j) {
    if (std::abs(sorted[j][axis] - sorted[i][axis]) >= best) return false;
    best = std::min(best, (sorted[j] - sorted[i]).stableNorm());
    return true;
  };
  for (std::size_t j = i + 1; j < sorted.size() && visit(j);)
    ++j;
  for (std::size_t j = i; j > 0 && visit(j - 1);)
    --j;
  return best;
}

std::optional<double> spacing(std::vector<Eigen::Vector3d> points, const Aabb& box) {
  constexpr std::size_t most_samples = 1000;
  if (points.size() < 2) return std::nullopt;
  Eigen::Index axis = 0;
  (box.max() - box.min()).maxCoeff(&axis);
  std::sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
  const std::size_t samples = std::min(points.size(), most_samples);
  std::vector<double> distances;
  for (std::size_t k = 0; k < samples; ++k)
    distances.push_back(nearest(points, k * points.size() / samples, axis));
  std::nth_element(distances.begin(), distances.begin() + samples / 2, distances.end());
  return distances[samples / 2];
}

}  // namespace

CloudInfo cloud_info(const RawCloud& cloud) {
  CloudInfo info;
  info.width = cloud.width;
  info.height = cloud.height;
  info.fields = cloud.fields;
  std::vector<Eigen::Vector3d> points = collect_points(cloud.xyz(), info);
  info.spacing = spacing(std::move(points), info.box);
  return info;
}

}  // namespace pcl_bv
