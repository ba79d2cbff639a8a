// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "extent_limits.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {
namespace {

// Lower and upper bounds of the sides of an object's upright box.
struct SizeBounds {
  UprightSize min, max;
};

struct Limits {
  UprightSize min{0, 0, 0};
  UprightSize max{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                  std::numeric_limits<double>::infinity()};
};

bool any_below(const UprightSize& size, const UprightSize& limit) {
  return size.along < limit.along || size.across < limit.across || size.up < limit.up;
}

// Returns the coordinate axis that `up` is parallel to, if any.
std::optional<int> vertical_axis(const Eigen::Vector3d& up) {
  for (int k = 0; k < 3; ++k) {
    if (std::abs(up[k]) == 1) return k;
  }
  return std::nullopt;
}

// Bounds the sides of the rectangle of minimum area by the sides a and b of the axis-aligned one, which holds
// the same points:
// - its longer side is at least its diagonal / sqrt(2), and its diagonal is at least max(a, b);
// - its longer side is the width of the points in a direction, so at most the diagonal of the other;
// - its shorter side is at most the square root of its area, which is at most a * b.
// Both boxes are rounded outwards by a few 2^-50 of the largest coordinate; 2^-40 of it covers all rounding.
SizeBounds bounds_of(const Aabb& box, int vertical) {
  const Eigen::Vector3d sides = box.max() - box.min();
  const double a = sides[(vertical + 1) % 3], b = sides[(vertical + 2) % 3], up = sides[vertical];
  const double rounding = 0x1p-40 * box.max().cwiseAbs().cwiseMax(box.min().cwiseAbs()).maxCoeff();
  return {{std::max(a, b) * std::sqrt(0.5) - rounding, 0, up - rounding},
          {std::hypot(a, b) + rounding, std::sqrt(a) * std::sqrt(b) + rounding, up + rounding}};
}

UprightSize size_of(const PointView& points, const Eigen::Vector3d& up, const Execution& execution) {
  Obb box;
  fit_obb(points, {ObbMethod::yaw, up}, box, execution);
  const Eigen::Vector3d sides = 2 * box.half_extents();
  return {std::max(sides[0], sides[1]), std::min(sides[0], sides[1]), sides[2]};
}

}  // namespace

void ExtentLimits::apply(const ClusterConfig& config, const Eigen::Vector3d& up,
                         const std::vector<PointView>& views, const Execution& execution, Clusters& clusters,
                         std::vector<std::int64_t>& class_of) {
  const Limits limits{config.min_extent.value_or(Limits().min), config.max_extent.value_or(Limits().max)};
  const std::optional<int> vertical = vertical_axis(up);
  verdicts_.assign(views.size(), Verdict::keep);
  const auto judge = [&](std::size_t i, const Execution& own) {
    if (vertical) {
      Aabb box;
      fit_aabb(views[i], box, own);
      const SizeBounds bounds = bounds_of(box, *vertical);
      if (any_below(bounds.max, limits.min)) {
        verdicts_[i] = Verdict::small;
        return;
      }
      if (!any_below(bounds.min, limits.min) && !any_below(limits.max, bounds.max)) return;
    }
    const UprightSize size = size_of(views[i], up, own);
    if (any_below(size, limits.min)) {
      verdicts_[i] = Verdict::small;
    } else if (any_below(limits.max, size)) {
      verdicts_[i] = Verdict::large;
    }
  };
  for_each_view(views, std::cref(judge), execution);
  drop(clusters, class_of);
}

void ExtentLimits::drop(Clusters& clusters, std::vector<std::int64_t>& class_of) const {
  std::size_t kept = 0, begin = 0;
  for (std::size_t i = 0; i < verdicts_.size(); ++i) {
    const std::size_t end = clusters.offsets[i + 1], size = end - begin;
    if (verdicts_[i] == Verdict::small) clusters.small_points += size;
    if (verdicts_[i] == Verdict::large) clusters.large_points += size;
    if (verdicts_[i] == Verdict::keep) {
      const auto first = clusters.indices.begin();
      const std::size_t to = clusters.offsets[kept];
      std::copy(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end),
                first + static_cast<std::ptrdiff_t>(to));
      if (!class_of.empty()) class_of[kept] = class_of[i];
      clusters.offsets[++kept] = to + size;
    }
    begin = end;
  }
  clusters.offsets.resize(kept + 1);
  clusters.indices.resize(clusters.offsets.back());
  if (!class_of.empty()) class_of.resize(kept);
}

}  // namespace pcl_bv::detail
