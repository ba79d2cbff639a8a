// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <optional>
#include <utility>

#include "kdop_support.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/volumes/kdop.h"
#include "polytope.h"

namespace pcl_bv {

using namespace detail;

namespace {

// Returns the index of the first slab along coordinate axis k, or size() if there is none.
std::size_t axis_slab(const KdopSet& set, int k) {
  std::size_t i = 0;
  while (i < set.size() && set.direction(i) != Eigen::Vector3d(Eigen::Vector3d::Unit(k)))
    ++i;
  return i;
}

}  // namespace

double Kdop::volume() const {
  const FloatEnvironment environment;
  return empty() ? 0 : intersect_slabs(*this).volume;
}

double Kdop::surface_area() const {
  const FloatEnvironment environment;
  return empty() ? 0 : detail::surface_area(intersect_slabs(*this));
}

Eigen::Vector3d Kdop::center() const {
  const FloatEnvironment environment;
  if (empty()) return Eigen::Vector3d::Constant(kNan);
  const Polytope polytope = intersect_slabs(*this);
  return polytope.origin + polytope.centroid;
}

Eigen::Vector3d Kdop::support(const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  if (empty()) return Eigen::Vector3d::Constant(kNan);
  const LocalSlabs slabs(*this);
  return slabs.origin() + slabs.corner(direction);
}

double Kdop::distance(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (empty() || !point.allFinite()) return kInfinity;
  if (contains(point)) return 0;
  const Polytope polytope = intersect_slabs(*this);
  return detail::distance(polytope, point - polytope.origin);
}

Aabb Kdop::aabb() const {
  const FloatEnvironment environment;
  if (empty()) return {};
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  std::optional<LocalSlabs> slabs;
  Eigen::Vector3d lower, upper;
  for (int k = 0; k < 3; ++k) {
    if (const std::size_t i = axis_slab(*set_, k); i < size()) {
      lower[k] = min(i);
      upper[k] = max(i);
      continue;
    }
    if (!slabs) slabs.emplace(*this);
    lower[k] = -slabs->support_up(identity, -identity.col(k));
    upper[k] = slabs->support_up(identity, identity.col(k));
  }
  return {lower, upper};
}

std::vector<Eigen::Vector3d> Kdop::corners() const {
  return mesh().vertices;
}

Mesh Kdop::mesh() const {
  const FloatEnvironment environment;
  if (empty()) return {};
  Polytope polytope = intersect_slabs(*this);
  for (Eigen::Vector3d& v : polytope.vertices)
    v += polytope.origin;
  return {std::move(polytope.vertices), std::move(polytope.faces)};
}

Kdop Kdop::tightened() const {
  const FloatEnvironment environment;
  if (empty()) return *this;
  const LocalSlabs slabs(*this);
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  SlabVector lower(min().size()), upper(lower.size());
  for (std::size_t i = 0; i < size(); ++i) {
    const Eigen::Vector3d& n = set_->direction(i);
    lower[i] = std::max(min(i), -slabs.support_up(identity, -n));
    upper[i] = std::min(max(i), slabs.support_up(identity, n));
  }
  // Both bounds of a slab are proven. If lower[i] > upper[i], the polytope has no point, and the constructor
  // makes the empty k-DOP.
  return {set_, lower, upper};
}

Kdop Kdop::transformed(const Eigen::Isometry3d& transform) const {
  const FloatEnvironment environment;
  if (empty()) return Kdop(set_);
  const LocalSlabs slabs(*this);
  SlabVector lower(min().size()), upper(lower.size());
  for (std::size_t i = 0; i < size(); ++i) {
    const Eigen::Vector3d& n = set_->direction(i);
    const auto support_bound = [&](const Eigen::Vector3d& direction) {
      const double rotated = slabs.support_up(transform.linear(), direction);
      return Expansion().add(rotated).add_dot(direction, transform.translation()).up();
    };
    lower[i] = -support_bound(-n);
    upper[i] = support_bound(n);
  }
  return {set_, lower, upper};
}

}  // namespace pcl_bv
