// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Shapes from a fixed seed.

#include "shapes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

namespace pcl_bv::bench {
namespace {

using Random = std::mt19937_64;

Eigen::Vector3d on_sphere(Random& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random);
  return Eigen::Vector3d(x, y, normal(random)).normalized();
}

Eigen::Vector3d in_ball(Random& random) {
  const Eigen::Vector3d p = on_sphere(random);
  return p * std::cbrt(std::uniform_real_distribution<double>(0, 1)(random));
}

Eigen::Vector3d on_golfball(Random& random) {
  const Eigen::Vector3d p = on_sphere(random);
  return p * (1 - 0.02 * std::max(0.0, std::sin(20 * p.x()) * std::sin(20 * p.y()) * std::sin(20 * p.z())));
}

Eigen::Vector3d on_car(Random& random) {
  std::normal_distribution<double> noise(0, 0.02);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::Vector3d half(2.25, 0.9, 0.75), place(20, 7, 0);
  Eigen::Vector3d p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = half[axis] * uniform(random);
  const auto side = static_cast<Eigen::Index>(random() % 3);
  p[side] = -half[side];
  for (int axis = 0; axis < 3; ++axis)
    p[axis] += noise(random);
  return place + p;
}

}  // namespace

std::vector<float> make_shape(const std::string& shape, std::size_t points) {
  Eigen::Vector3d (*draw)(Random&) = shape == "ball"       ? in_ball
                                     : shape == "surface"  ? on_sphere
                                     : shape == "golfball" ? on_golfball
                                     : shape == "car"      ? on_car
                                                           : nullptr;
  std::vector<float> xyz;
  if (draw == nullptr) return xyz;
  Random random(1);
  for (std::size_t i = 0; i < points; ++i) {
    const Eigen::Vector3d p = draw(random);
    for (int axis = 0; axis < 3; ++axis)
      xyz.push_back(static_cast<float>(p[axis]));
  }
  return xyz;
}

}  // namespace pcl_bv::bench
