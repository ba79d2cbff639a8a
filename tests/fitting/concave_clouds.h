// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds with bays, and the claims of every prism around a cloud.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "clouds.h"
#include "encloses.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/volumes/simple_polygon.h"

namespace pcl_bv::test {

template <typename T>
TestCloud<T> cloud_of(const std::vector<Eigen::Vector3d>& points) {
  TestCloud<T> cloud;
  for (const Eigen::Vector3d& p : points) {
    for (const double c : p)
      cloud.xyz.push_back(static_cast<T>(c));
  }
  return cloud;
}

inline Eigen::Vector3d in_box(std::mt19937_64& random, const Eigen::Vector3d& low,
                              const Eigen::Vector3d& high) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Eigen::Vector3d p;
  for (int k = 0; k < 3; ++k)
    p[k] = low[k] + uniform(random) * (high[k] - low[k]);
  return p;
}

/// Points of boxes, an equal number in each.
inline std::vector<Eigen::Vector3d> in_boxes(
    std::mt19937_64& random, std::size_t count,
    const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& boxes) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [low, high] = boxes[i % boxes.size()];
    points.push_back(in_box(random, low, high));
  }
  return points;
}

/// A hedge of 1 m around a corner, 28 m and 11 m long.
inline std::vector<Eigen::Vector3d> hedge(std::mt19937_64& random, std::size_t count) {
  std::vector<Eigen::Vector3d> points = in_boxes(random, count * 28 / 38, {{{0, 0, 0}, {28, 1, 2}}});
  const std::vector<Eigen::Vector3d> leg = in_boxes(random, count * 10 / 38, {{{0, 1, 0}, {1, 11, 2}}});
  points.insert(points.end(), leg.begin(), leg.end());
  return points;
}

/// The bodies that have bays, and those that make ties: lattices, lines, circles, equal points.
inline std::vector<Eigen::Vector3d> body(int kind, std::mt19937_64& random, std::size_t count) {
  std::vector<Eigen::Vector3d> points;
  switch (kind % 9) {
    case 0:
      return hedge(random, count);
    case 1:  // a U
      return in_boxes(random, count,
                      {{{0, 0, 0}, {6, 1, 1}}, {{0, 0, 0}, {1, 8, 1}}, {{5, 0, 0}, {6, 8, 1}}});
    case 2:  // a comb
      return in_boxes(random, count,
                      {{{0, 0, 0}, {9, 1, 1}},
                       {{0, 0, 0}, {1, 5, 1}},
                       {{2, 0, 0}, {3, 5, 1}},
                       {{4, 0, 0}, {5, 5, 1}},
                       {{8, 0, 0}, {9, 5, 1}}});
    case 3:  // a ring with a gap
      for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector3d p = in_box(random, {0.3, 4, 0}, {6, 5, 1});
        points.emplace_back(p.y() * std::cos(p.x()), p.y() * std::sin(p.x()), p.z());
      }
      return points;
    default:
      break;
  }
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d p = in_box(random, {-5, -5, -1}, {5, 5, 1});
    if (kind % 9 == 4) p = p.array().round();                       // a lattice
    if (kind % 9 == 5) p[i % 2] = 0;                                // two lines that cross
    if (kind % 9 == 6) p.head<2>() = 5 * p.head<2>().normalized();  // on a circle
    if (kind % 9 == 7 && (p.x() > -4 && p.y() > -4)) p.head<2>() = p.head<2>().array().round().min(-4.0);
    points.push_back(p);
  }
  return points;
}

/// Expects that the prism encloses the cloud exactly and is never larger than the convex one.
template <typename T>
void expect_sound(const TestCloud<T>& cloud, const Eigen::Vector3d& up, double length,
                  const std::string& what) {
  const Prism prism = *fit_prism(cloud.view(), {up, length});
  ASSERT_NO_FATAL_FAILURE(expect_encloses(prism, cloud.view())) << what;
  ASSERT_EQ(verify(prism, cloud.view()).outside, 0U) << what;
  const Prism convex = *fit_prism(cloud.view(), up);
  const Aabb box = convex.aabb();
  const double rounding =
      0x1p-47 * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const double allowed = up.maxCoeff() == 1 ? 0 : 4 * rounding * (box.max() - box.min()).sum();
  ASSERT_LE(prism.footprint_area(), convex.footprint_area() * (1 + 1e-12) + allowed) << what;
  ASSERT_EQ(prism.low(), convex.low());
  ASSERT_EQ(prism.high(), convex.high());
  if (prism.is_convex()) {
    ASSERT_EQ(prism, convex) << what;
  } else {
    ASSERT_TRUE(detail::is_simple_polygon(prism.outline())) << what;
  }
}

}  // namespace pcl_bv::test
