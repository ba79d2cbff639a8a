// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds and comparisons for the tests of spheres.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <string>
#include <string_view>

#include "clouds.h"
#include "pcl_bv/volumes/sphere.h"

namespace pcl_bv::test {

inline void expect_equal(const Sphere& a, const Sphere& b) {
  EXPECT_EQ(a.empty(), b.empty());
  if (a.empty() || b.empty()) return;
  EXPECT_EQ(a.center(), b.center());
  EXPECT_EQ(a.radius(), b.radius());
}

/// Points on or in shapes that make solvers fail.
inline TestCloud<float> points_of(const char* shape, std::size_t n, double offset = 0) {
  TestCloud<float> cloud{std::string(shape) + " " + std::to_string(n) + " at " + std::to_string(offset), {}};
  std::mt19937_64 random(n);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::string_view name = shape;
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Vector3d p(normal(random), normal(random), normal(random));
    if (name == "ball") p = p.normalized() * std::cbrt(uniform(random));
    if (name == "surface") p.normalize();
    if (name == "hemisphere") p = p.normalized().cwiseProduct(Eigen::Vector3d(1, 1, p.z() < 0 ? -1 : 1));
    if (name == "circle") p = Eigen::Vector3d(p.x(), p.y(), 0).normalized();
    if (name == "corners") p = p.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; });
    if (name == "line") p = Eigen::Vector3d(1, 2, -3) * p.x();
    if (name == "two clusters") p = p.normalized() * 1e-3 + Eigen::Vector3d(i % 2 == 0 ? 1 : -1, 0, 0);
    for (int axis = 0; axis < 3; ++axis)
      cloud.xyz.push_back(static_cast<float>(offset + p[axis]));
  }
  return cloud;
}

}  // namespace pcl_bv::test
