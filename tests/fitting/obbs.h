// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds and helpers that the tests of oriented boxes share.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <random>

#include "clouds.h"
#include "pcl_bv/fitting/fit.h"

namespace pcl_bv::test {

inline constexpr ObbMethod kMethods[] = {ObbMethod::pca, ObbMethod::dito14, ObbMethod::minimal,
                                         ObbMethod::yaw, ObbMethod::lshape};
inline constexpr ObbMethod kAnyAxes[] = {ObbMethod::pca, ObbMethod::dito14, ObbMethod::minimal};
inline constexpr ObbMethod kUpright[] = {ObbMethod::yaw, ObbMethod::lshape};

template <typename T>
Obb fit(const TestCloud<T>& cloud, const ObbOptions& options, const Execution& execution = {}) {
  Obb box = *fit_obb(cloud.view(), options, execution);
  return box;
}

inline Eigen::Matrix3d random_turn(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

inline Eigen::Matrix3d yaw_turn(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

// Points in and on a box: its corners, and others by `inside`, uniform in [-1, 1]^3.
template <typename T>
TestCloud<T> box_cloud(const Eigen::Vector3d& half, const Eigen::Matrix3d& turn,
                       const Eigen::Vector3d& center, int n, std::uint64_t seed) {
  TestCloud<T> cloud{"box", {}};
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < n; ++i) {
    Eigen::Vector3d p(uniform(random), uniform(random), uniform(random));
    if (i < 8) p = {i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
    p = center + turn * p.cwiseProduct(half);
    for (const double c : p)
      cloud.xyz.push_back(static_cast<T>(c));
  }
  return cloud;
}

// Whether the axes are those of the turn, up to names.
inline double misalignment(const Obb& box, const Eigen::Matrix3d& turn) {
  const Obb named({0, 0, 0}, orthonormal_axes(turn), {1, 1, 1});
  return (box.oriented_as(named).axes() - named.axes()).norm();
}

}  // namespace pcl_bv::test
