// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/kdop.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/float_environment.h"
#include "projection.h"
#include "ray_clip.h"

namespace pcl_bv {

using namespace detail;

namespace {

void require_equal_sets(const Kdop& a, const Kdop& b, const char* function) {
  if (a.set() != b.set() && *a.set() != *b.set()) {
    throw std::invalid_argument(std::string(function) + ": both k-DOPs must have the same directions");
  }
}

}  // namespace

Kdop::Kdop(std::shared_ptr<const KdopSet> set) : set_(std::move(set)) {
  if (!set_) throw std::invalid_argument("Kdop: the set must not be null");
  if (size() > max_inline_slabs) heap_numbers_.resize(2 * size());
  std::fill_n(numbers(), size(), kInfinity);
  std::fill_n(numbers() + size(), size(), -kInfinity);
}

Kdop::Kdop(std::shared_ptr<const KdopSet> set, const SlabVector& min, const SlabVector& max)
    : Kdop(std::move(set)) {
  const FloatEnvironment environment;
  const auto n = static_cast<Eigen::Index>(size());
  if (min.size() != n || max.size() != n) {
    throw std::invalid_argument("Kdop: min and max must have " + std::to_string(n) +
                                " numbers, one per slab");
  }
  if ((min.array() > max.array()).any()) return;
  if (!min.allFinite() || !max.allFinite()) {
    throw std::invalid_argument(
        "Kdop: min and max must be finite (or any min above its max, for an empty k-DOP)");
  }
  store(min.array() + 0.0, max.array() + 0.0);
}

void Kdop::store(const SlabVector& min, const SlabVector& max) {
  std::copy_n(min.data(), size(), numbers());
  std::copy_n(max.data(), size(), numbers() + size());
}

double Kdop::width(std::size_t i) const {
  const FloatEnvironment environment;
  return empty() ? 0 : (max(i) - min(i)) / set_->direction(i).norm();
}

bool Kdop::empty() const {
  return min(0) > max(0);
}

bool Kdop::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  for (std::size_t i = 0; i < size(); ++i) {
    const auto [s, error] = project(set_->direction(i), point);
    if (!(s - error <= max(i) && s + error >= min(i))) return false;
  }
  return point.allFinite();
}

std::optional<RayInterval> Kdop::intersect(const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction) const {
  return intersect_ray(*this, origin, direction, [&](RayClip& ray) {
    for (std::size_t i = 0; i < size(); ++i) {
      const Projection start = project(set_->direction(i), origin);
      const Projection step = project(set_->direction(i), direction);
      ray.keep(step.low(), max(i) - start.low());
      ray.keep(-step.high(), start.high() - min(i));
    }
  });
}

bool Kdop::overlaps(const Kdop& other) const {
  const FloatEnvironment environment;
  require_equal_sets(*this, other, "Kdop::overlaps");
  return (min().array() <= other.max().array()).all() && (other.min().array() <= max().array()).all();
}

Kdop& Kdop::extend(const Eigen::Vector3d& point) {
  const FloatEnvironment environment;
  if (!point.allFinite()) return *this;
  for (std::size_t i = 0; i < size(); ++i) {
    const Eigen::Vector3d& n = set_->direction(i);
    const auto [s, error] = project(n, point);
    if (s - error >= min(i) && s + error <= max(i)) continue;
    Expansion exact;
    exact.add_dot(n, point);
    numbers()[i] = std::min(min(i), exact.down() + 0.0);
    numbers()[size() + i] = std::max(max(i), exact.up() + 0.0);
  }
  return *this;
}

Kdop& Kdop::merge(const Kdop& other) {
  const FloatEnvironment environment;
  require_equal_sets(*this, other, "Kdop::merge");
  store(min().cwiseMin(other.min()), max().cwiseMax(other.max()));
  return *this;
}

FloatKdop Kdop::cast_float() const {
  const FloatEnvironment environment;
  return {set_, min().unaryExpr([](double x) { return float_down(x); }),
          max().unaryExpr([](double x) { return float_up(x); })};
}

bool operator==(const Kdop& a, const Kdop& b) {
  const FloatEnvironment environment;
  return (a.set() == b.set() || *a.set() == *b.set()) && a.min() == b.min() && a.max() == b.max();
}

}  // namespace pcl_bv
