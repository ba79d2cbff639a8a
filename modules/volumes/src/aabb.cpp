// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/aabb.h"

#include <stdexcept>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/float_environment.h"
#include "ray_clip.h"

namespace pcl_bv {

using namespace detail;

Aabb::Aabb() : min_(Eigen::Vector3d::Constant(kInfinity)), max_(Eigen::Vector3d::Constant(-kInfinity)) {}

Aabb::Aabb(const Eigen::Vector3d& min, const Eigen::Vector3d& max) : Aabb() {
  const FloatEnvironment environment;
  if ((min.array() > max.array()).any()) return;
  if (!min.allFinite() || !max.allFinite()) {
    throw std::invalid_argument(
        "Aabb: min and max must be finite (or any min above its max, for an empty box)");
  }
  min_ = min.array() + 0.0;
  max_ = max.array() + 0.0;
}

bool Aabb::empty() const {
  return min_.x() > max_.x();
}

bool Aabb::contains(const Eigen::Vector3d& p) const {
  const FloatEnvironment environment;
  return min_.x() <= p.x() && p.x() <= max_.x() && min_.y() <= p.y() && p.y() <= max_.y() &&
         min_.z() <= p.z() && p.z() <= max_.z();
}

double Aabb::volume() const {
  const FloatEnvironment environment;
  if (empty()) return 0;
  const Eigen::Vector3d size = max_ - min_;
  return product_of(size.y(), size.z(), size.x());
}

double Aabb::surface_area() const {
  const FloatEnvironment environment;
  if (empty()) return 0;
  const Eigen::Vector3d size = max_ - min_;
  return 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
}

Eigen::Vector3d Aabb::center() const {
  const FloatEnvironment environment;
  if (empty()) return Eigen::Vector3d::Constant(kNan);
  return 0.5 * (min_ + max_);
}

Eigen::Vector3d Aabb::support(const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  if (empty()) return Eigen::Vector3d::Constant(kNan);
  return (direction.array() < 0).select(min_, max_);
}

double Aabb::distance(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (empty() || !point.allFinite()) return kInfinity;
  const Eigen::Vector3d excess = (min_ - point).cwiseMax(point - max_).cwiseMax(0.0);
  return excess.stableNorm();
}

std::optional<RayInterval> Aabb::intersect(const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction) const {
  return intersect_ray(*this, origin, direction, [&](RayClip& ray) {
    for (int k = 0; k < 3; ++k) {
      ray.keep(direction[k], max_[k] - origin[k]);
      ray.keep(-direction[k], origin[k] - min_[k]);
    }
  });
}

bool Aabb::overlaps(const Aabb& other) const {
  const FloatEnvironment environment;
  return (min_.array() <= other.max_.array()).all() && (other.min_.array() <= max_.array()).all();
}

std::array<Eigen::Vector3d, 8> Aabb::corners() const {
  std::array<Eigen::Vector3d, 8> result;
  for (unsigned i = 0; i < 8; ++i) {
    result[i] = {i & 1 ? max_.x() : min_.x(), i & 2 ? max_.y() : min_.y(), i & 4 ? max_.z() : min_.z()};
  }
  return result;
}

Mesh Aabb::mesh() const {
  if (empty()) return {};
  const std::array<Eigen::Vector3d, 8> c = corners();
  return {{c.begin(), c.end()},
          {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
}

Aabb Aabb::transformed(const Eigen::Isometry3d& transform) const {
  const FloatEnvironment environment;
  if (empty()) return {};
  Eigen::Vector3d lower, upper;
  for (int i = 0; i < 3; ++i) {
    Expansion low, high;
    low.add(transform(i, 3));
    high.add(transform(i, 3));
    for (int j = 0; j < 3; ++j) {
      const double m = transform(i, j);
      low.add_product(m, m < 0 ? max_[j] : min_[j]);
      high.add_product(m, m < 0 ? min_[j] : max_[j]);
    }
    lower[i] = low.down();
    upper[i] = high.up();
  }
  return {lower, upper};
}

Aabb& Aabb::extend(const Eigen::Vector3d& point) {
  return point.allFinite() ? merge({point, point}) : *this;
}

Aabb& Aabb::merge(const Aabb& other) {
  const FloatEnvironment environment;
  min_ = min_.cwiseMin(other.min_);
  max_ = max_.cwiseMax(other.max_);
  return *this;
}

FloatAabb Aabb::cast_float() const {
  const FloatEnvironment environment;
  return {min_.unaryExpr([](double x) { return float_down(x); }),
          max_.unaryExpr([](double x) { return float_up(x); })};
}

bool operator==(const Aabb& a, const Aabb& b) {
  const FloatEnvironment environment;
  return a.min() == b.min() && a.max() == b.max();
}

}  // namespace pcl_bv
