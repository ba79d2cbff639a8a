// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The judge of these tests: the predicates of the volumes in rational numbers, and clouds to try them on.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/kdop.h"
#include "pcl_bv/volumes/sphere.h"
#include "rational.h"

namespace pcl_bv::testing {

using test::Rational;
using ExactPoint = std::array<Rational, 3>;

inline ExactPoint exact(const Eigen::Vector3d& p) {
  return {Rational(p.x()), Rational(p.y()), Rational(p.z())};
}

inline Rational dot(const Eigen::Vector3d& n, const ExactPoint& p) {
  return Rational(n.x()) * p[0] + Rational(n.y()) * p[1] + Rational(n.z()) * p[2];
}

inline ExactPoint image(const Eigen::Isometry3d& t, const ExactPoint& p) {
  ExactPoint result;
  for (int i = 0; i < 3; ++i) {
    result[static_cast<std::size_t>(i)] = dot(t.linear().row(i).transpose(), p) + Rational(t(i, 3));
  }
  return result;
}

inline bool inside(const Aabb& box, const ExactPoint& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<int>(i);
    if (p[i] < Rational(box.min()[k]) || p[i] > Rational(box.max()[k])) return false;
  }
  return true;
}

inline bool inside(const Kdop& kdop, const ExactPoint& p) {
  for (std::size_t i = 0; i < kdop.size(); ++i) {
    const Rational s = dot(kdop.set()->direction(i), p);
    if (s < Rational(kdop.min(i)) || s > Rational(kdop.max(i))) return false;
  }
  return true;
}

inline Rational squared_distance(const ExactPoint& a, const ExactPoint& b) {
  Rational sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

inline bool inside(const Sphere& sphere, const ExactPoint& p) {
  return squared_distance(exact(sphere.center()), p) <= Rational(sphere.radius()) * Rational(sphere.radius());
}

/// Whether `outer` holds all of `inner`: |c - c'| <= r - r'.
inline bool encloses(const Sphere& outer, const Sphere& inner) {
  const Rational slack = Rational(outer.radius()) - Rational(inner.radius());
  return slack >= 0 && squared_distance(exact(outer.center()), exact(inner.center())) <= slack * slack;
}

/// A place and size at which a volume has to work.
struct Scale {
  std::string name;
  double offset;
  double extent;
};

inline std::vector<Scale> scales() {
  return {{"unit", 0, 1},        {"utm", 5e6, 1},   {"utm, 1 mm", 5e6, 1e-3}, {"1e-41", 0, 1e-41},
          {"1e-20", 0, 1e-20},   {"1e20", 0, 1e20}, {"1.2e38", 0, 1.2e38},    {"1e-100", 0, 1e-100},
          {"1e-200", 0, 1e-200}, {"1e99", 0, 1e99}};
}

/// Which shape the points of cloud() span.
enum class Span { solid, plane, line, point };

inline std::vector<Span> spans() {
  return {Span::solid, Span::plane, Span::line, Span::point};
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  Eigen::Vector3d vector(double extent) {
    return {uniform(-extent, extent), uniform(-extent, extent), uniform(-extent, extent)};
  }

  Eigen::Vector3d point(const Scale& scale) {
    return Eigen::Vector3d(scale.offset, -scale.offset, 0.1 * scale.offset) + vector(scale.extent);
  }

  Eigen::Isometry3d isometry(double extent) {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    result.linear() = Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1))
                          .normalized()
                          .toRotationMatrix();
    result.translation() = vector(extent);
    return result;
  }

  /// Points spanning `span` up to the rounding of doubles.
  std::vector<Eigen::Vector3d> cloud(const Scale& scale, Span span, std::size_t size) {
    const Eigen::Vector3d origin = point(scale), u = vector(scale.extent), v = vector(scale.extent),
                          w = vector(scale.extent);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < size; ++i) {
      Eigen::Vector3d p = origin;
      if (span != Span::point) p += uniform(-1, 1) * u;
      if (span == Span::plane || span == Span::solid) p += uniform(-1, 1) * v;
      if (span == Span::solid) p += uniform(-1, 1) * w;
      points.push_back(p);
    }
    return points;
  }

 private:
  std::mt19937_64 engine_;
};

template <typename Volume>
Volume around(Volume volume, const std::vector<Eigen::Vector3d>& points) {
  for (const Eigen::Vector3d& p : points)
    volume.extend(p);
  return volume;
}

}  // namespace pcl_bv::testing
