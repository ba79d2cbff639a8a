// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds for the tests of the ground, and a short way to split them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "pcl_bv/segmentation/ground.h"

namespace pcl_bv {

template <typename T>
using Cloud = std::vector<std::array<T, 3>>;

template <typename T>
PointView scene_view(const Cloud<T>& cloud) {
  return PointView::of(cloud.empty() ? nullptr : cloud[0].data(), sizeof(std::array<T, 3>), cloud.size());
}

template <typename T>
GroundSplit split(const Cloud<T>& cloud, const GroundPlaneOptions& settings = {}) {
  GroundSplit result;
  split_ground(scene_view(cloud), settings, result);
  return result;
}

inline std::vector<std::int32_t> numbers(std::size_t begin, std::size_t end) {
  std::vector<std::int32_t> result(end - begin);
  std::iota(result.begin(), result.end(), static_cast<std::int32_t>(begin));
  return result;
}

/// x, y, z, -x, -y or -z.
inline Eigen::Vector3d axis_up(unsigned number) {
  return (number < 3 ? 1 : -1) * Eigen::Vector3d::Unit(number % 3);
}

/// A cloud whose z is up, turned so that axis_up() of this number is.
inline Cloud<float> turned(const Cloud<float>& upright, unsigned axis) {
  Cloud<float> result;
  for (const auto& p : upright) {
    std::array<float, 3> q;
    q[axis % 3] = axis < 3 ? p[2] : -p[2];
    q[(axis + 1) % 3] = p[0];
    q[(axis + 2) % 3] = p[1];
    result.push_back(q);
  }
  return result;
}

/// A random rotation.
inline Eigen::Matrix3d any_rotation(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

inline Cloud<float> turned(const Cloud<float>& cloud, const Eigen::Matrix3d& rotation) {
  Cloud<float> result;
  for (const auto& p : cloud) {
    const Eigen::Vector3f q = (rotation * Eigen::Vector3d(p[0], p[1], p[2])).cast<float>();
    result.push_back({q.x(), q.y(), q.z()});
  }
  return result;
}

/// `count` points on the rectangle of `half` metres around (x, y), at the heights slope * x + height + noise.
template <typename T>
void add_plane(Cloud<T>& cloud, std::size_t count, T half, T x, T y, T height, T slope = 0, T noise = 0) {
  std::mt19937 random(static_cast<std::uint32_t>(cloud.size() + count));
  std::uniform_real_distribution<T> uniform(-1, 1);
  for (std::size_t i = 0; i < count; ++i) {
    const T px = x + half * uniform(random);
    const T py = y + half * uniform(random);
    cloud.push_back({px, py, slope * px + height + noise * uniform(random)});
  }
}

using Height = double (*)(double, double);

/// The rings of a sensor's beams on ground of the given height, noise of 1 cm, out to 70 m.
inline Cloud<float> ground_of(Height height) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  Cloud<float> cloud;
  for (double radius = 3; radius < 70; radius *= 1.04) {
    for (int i = 0; i < 500; ++i) {
      const double angle = (i + unit(random)) * 0.0125664, r = radius * (1 + 0.02 * unit(random));
      const double x = r * std::cos(angle), y = r * std::sin(angle);
      cloud.push_back({static_cast<float>(x), static_cast<float>(y),
                       static_cast<float>(height(x, y) + 0.01 * unit(random))});
    }
  }
  return cloud;
}

/// Boxes on the ground, their sides 0.3 m to 2 m above it.
inline void add_boxes(Cloud<float>& cloud, Height height) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int box = 0; box < 12; ++box) {
    const double x = (8 + 4 * box) * std::cos(0.9 * box), y = (8 + 4 * box) * std::sin(0.9 * box);
    for (int i = 0; i < 200; ++i) {
      const double px = x + 0.8 * unit(random), py = y + 0.8;
      cloud.push_back({static_cast<float>(px), static_cast<float>(py),
                       static_cast<float>(height(px, py) + 1.15 + 0.85 * unit(random))});
    }
  }
}

}  // namespace pcl_bv
