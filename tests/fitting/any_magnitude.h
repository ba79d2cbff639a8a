// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Random clouds of few points whose coordinates have any valid magnitude, a different one along each axis.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "clouds.h"

namespace pcl_bv::test {

/// Random numbers, clouds and directions of one case. Equal seeds give equal cases on every machine.
class AnyMagnitude {
 public:
  explicit AnyMagnitude(std::uint64_t seed) : random_(seed * 0x9E3779B97F4A7C15U + 1) {}

  bool chance(double probability) { return unit() < probability; }
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  double sign() { return chance(0.5) ? -1 : 1; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }

  /// A positive number whose logarithm is uniform. With `low` = -1074, also denormal numbers.
  double power(int low, int high) {
    return std::ldexp(chance(0.5) ? 1 : uniform(1, 2), low + static_cast<int>(below(high - low + 1U)));
  }

  template <typename T>
  TestCloud<T> cloud() {
    set_range<T>();
    std::vector<Eigen::Vector3d> points = chance(0.3) ? lattice() : pattern();
    const Eigen::Vector3d size = sizes(), offset = offsets(size);
    const bool rotated = chance(0.15);
    const Eigen::Matrix3d rotation = Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), 1.1)
                                         .normalized()
                                         .toRotationMatrix();
    for (Eigen::Vector3d& p : points) {
      p = p.cwiseProduct(size);
      if (rotated) p = rotation * p;
      p += offset;
    }
    perturb(points, size);
    TestCloud<T> cloud{"any magnitude", {}};
    for (const Eigen::Vector3d& p : points) {
      for (const double c : p)
        cloud.xyz.push_back(static_cast<T>(c == 0 && chance(0.3) ? -c : c));
    }
    if (chance(0.05)) cloud.xyz[below(cloud.xyz.size())] = std::numeric_limits<T>::quiet_NaN();
    return cloud;
  }

  /// A valid up direction: an axis, at any distance from an axis down to 2^-1074, or any direction. Its
  /// length is 1 or any other that is valid.
  Eigen::Vector3d up() {
    Eigen::Vector3d up(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const std::uint64_t kind = below(8);
    if (kind < 5) {
      const auto axis = static_cast<int>(below(3));
      up = sign() * Eigen::Vector3d::Unit(axis);
      if (kind > 0) up[(axis + 1) % 3] = sign() * power(-1074, -1);
      if (kind > 2) up[(axis + 2) % 3] = sign() * power(-1074, -1);
    } else if (kind == 5) {
      up = Eigen::Vector3d(small_integer(), small_integer(), small_integer());
      if (up.isZero(0)) up.z() = 1;
    } else if (kind == 6) {
      up = {6.123233995736766e-17, 0, 1};  // the cosine and the sine of 90 degrees
    }
    return chance(0.3) ? Eigen::Vector3d(up * power(-94, 94)) : up;
  }

 private:
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double small_integer() { return static_cast<double>(below(5)) - 2; }

  template <typename T>
  void set_range() {
    constexpr bool is_float = std::is_same_v<T, float>;
    least_ = is_float ? -149 : -1074;
    normal_ = is_float ? -126 : -997;  // 2^-997 is 1e-300
    most_ = is_float ? 124 : 329;      // a few times 2^329 is less than 1e100
  }

  std::size_t count() {
    if (chance(0.003)) return 600;
    return 1 + below(chance(0.15) ? 40 : chance(0.5) ? 5 : 12);
  }

  double magnitude() {
    if (chance(0.1)) return power(least_, normal_);
    return chance(0.3) ? 1 : power(normal_, most_);
  }

  // Sizes along the axes: all equal, two equal, or all different. An axis may have the size 0.
  Eigen::Vector3d sizes() {
    Eigen::Vector3d size = Eigen::Vector3d::Constant(magnitude());
    const std::uint64_t kind = below(4);
    if (kind > 1) size[static_cast<int>(below(3))] = magnitude();
    if (kind > 2) size[static_cast<int>(below(3))] = chance(0.3) ? 0 : magnitude();
    return size;
  }

  Eigen::Vector3d offsets(const Eigen::Vector3d& size) {
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    if (chance(0.7)) return offset;
    for (int k = 0; k < 3; ++k) {
      if (chance(0.5)) offset[k] = sign() * (chance(0.5) ? magnitude() : size[k] * uniform(1, 1000));
    }
    return offset.cwiseMax(-0x1p330).cwiseMin(0x1p330);
  }

  // Small integers, many of them 0: coplanar, collinear and equal points, boxes and simplices.
  std::vector<Eigen::Vector3d> lattice() {
    const double zeros = uniform(0, 0.8);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t n = count(); n > 0; --n) {
      points.emplace_back(small_integer(), small_integer(), small_integer());
      for (double& c : points.back())
        if (chance(zeros)) c = 0;
    }
    return points;
  }

  std::vector<Eigen::Vector3d> pattern() {
    const std::uint64_t kind = below(6);
    const Eigen::Vector3d a(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)),
        b(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const double second = power(kind == 4 ? -60 : -1000, 0);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t n = count(); n > 0; --n) {
      Eigen::Vector3d p(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (kind == 0) p = Eigen::Vector3d(sign(), sign(), sign());  // corners of a box
      if (kind == 1) p = p.x() * a;                                // on a line
      if (kind == 2) p = p.x() * a + p.y() * b;                    // in a plane
      if (kind == 3) p.normalize();                                // on a sphere
      if (kind == 4) p = a + second * p;                           // near one point
      if (kind == 5) {                                             // sums of two magnitudes
        for (double& c : p)
          c = small_integer() + second * small_integer();
      }
      points.push_back(p);
    }
    return points;
  }

  // Repeats a few points, and moves a few coordinates by tiny amounts, mostly those of repeated points. So
  // two points may be so near to each other that squares of their distance underflow.
  void perturb(std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& size) {
    const std::uint64_t copies = below(3);
    for (std::uint64_t i = 0; i < copies; ++i)
      points.push_back(Eigen::Vector3d(points[below(points.size())]));
    const int most = std::max(std::ilogb(size.maxCoeff()), least_ + 1);
    for (std::uint64_t moves = below(4); moves > 0; --moves) {
      const std::uint64_t among = copies > 0 && chance(0.7) ? copies : points.size();
      double& c = points[points.size() - 1 - below(among)][static_cast<int>(below(3))];
      if (chance(0.3)) {
        c = std::nextafter(c, sign() * std::numeric_limits<double>::infinity());
      } else {
        c = (chance(0.3) ? 0 : c) + sign() * power(least_, most);
      }
    }
    for (std::size_t i = points.size() - 1; i > 0; --i)
      std::swap(points[i], points[below(i + 1)]);
  }

  std::mt19937_64 random_;
  int least_ = 0, normal_ = 0, most_ = 0;  // exponents of magnitudes
};

}  // namespace pcl_bv::test
