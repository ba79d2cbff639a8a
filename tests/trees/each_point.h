// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What trees over points are judged by: every point asked by itself.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <ostream>
#include <random>
#include <vector>

#include "any_volumes.h"
#include "clouds.h"
#include "pcl_bv/trees/point_tree.h"

namespace pcl_bv {
using namespace detail;

inline bool operator==(const Neighbor& a, const Neighbor& b) {
  return a.index == b.index && a.squared_distance == b.squared_distance;
}

inline void PrintTo(const Neighbor& neighbor, std::ostream* out) {
  *out << neighbor.index << " at " << neighbor.squared_distance;
}

namespace testing {

// All valid points of a view, one after another: what the tree is judged by.
class EachPoint {
 public:
  explicit EachPoint(const PointView& view) {
    for (std::size_t i = 0; i < view.count; ++i) {
      const Coordinates p = load_point(view, i);
      if (!is_valid(p)) continue;
      places_.emplace_back(p.x, p.y, p.z);
      numbers_.push_back(static_cast<std::int32_t>(view.index(i)));
    }
  }

  std::size_t size() const { return places_.size(); }
  const std::vector<Vector3d>& places() const { return places_; }

  std::vector<Neighbor> near(const Vector3d& place, double limit) const {
    std::vector<Neighbor> found;
    for (std::size_t i = 0; i < size(); ++i) {
      const Vector3d d = places_[i] - place;
      const double square = (d.x() * d.x() + d.y() * d.y()) + d.z() * d.z();
      if (square <= limit) found.push_back({numbers_[i], square});
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  std::vector<std::int32_t> inside(const AnyVolume& volume) const {
    std::vector<std::int32_t> found;
    for (std::size_t i = 0; i < size(); ++i) {
      if (contains(volume, places_[i])) found.push_back(numbers_[i]);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  std::optional<PointHit> first_hit(const Vector3d& origin, const Vector3d& direction, double radius) const {
    std::optional<PointHit> first;
    for (std::size_t i = 0; i < size(); ++i) {
      const auto inside = Sphere(places_[i], radius).intersect(origin, direction);
      if (!inside) continue;
      if (!first || inside->enter < first->t || (inside->enter == first->t && numbers_[i] < first->index))
        first = PointHit{numbers_[i], inside->enter};
    }
    return first;
  }

 private:
  std::vector<Vector3d> places_;
  std::vector<std::int32_t> numbers_;
};

// Points of the cloud, near them, and anywhere about it, with distances from 0 to beyond its size.
class Questions {
 public:
  Questions(const EachPoint& points, std::uint64_t seed) : points_(points), random_(seed) {
    box_ = Aabb(Vector3d::Zero(), Vector3d::Zero());
    if (points.size() > 0) box_ = Aabb();
    for (const Vector3d& p : points.places())
      box_.extend(p);
    size_ = std::max((box_.max() - box_.min()).maxCoeff(), 1e-300);
  }

  Vector3d place() {
    const double size = size_ * std::pow(10.0, uniform(-8, 1));
    const Vector3d step = size * Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    if (points_.size() == 0 || random_() % 4 == 0) return box_.center() + step;
    const Vector3d& point = points_.places()[random_() % points_.size()];
    return random_() % 4 == 0 ? point : Vector3d(point + step);
  }

  Vector3d direction() {
    Vector3d direction(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    if (random_() % 3 == 0) direction[static_cast<int>(random_() % 3)] = 0;
    if (random_() % 3 == 0 && points_.size() > 0) return place() - place();
    return std::pow(10.0, uniform(-3, 3)) * direction;
  }

  // Now and then exactly that of a point.
  double distance(const Vector3d& from) {
    if (points_.size() > 0 && random_() % 3 == 0)
      return (points_.places()[random_() % points_.size()] - from).norm();
    return size_ * std::pow(10.0, uniform(-8, 0.5));
  }

  double size() const { return size_; }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  const EachPoint& points_;
  std::mt19937_64 random_;
  Aabb box_;
  double size_ = 0;
};

// Calls body(tree, points, cloud) for every nasty cloud and instruction set, until something fails.
template <typename T, typename Body>
void for_each_tree(const Body& body) {
  for (const auto& cloud : test::nasty_clouds<T>()) {
    SCOPED_TRACE(cloud.name);
    const EachPoint points(cloud.view());
    for (const Isa isa : usable_isas()) {
      SCOPED_TRACE(isa_name(isa));
      body(PointTree(cloud.view(), {Serial{}, isa}), points, cloud);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

}  // namespace testing
}  // namespace pcl_bv
