// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The sweep is not made by datasets-synth, because casting rays would take longer than processing the frames.

#include "synthetic_sweep.h"

#include <cmath>
#include <memory>
#include <vector>

#include "pcl_bv/segmentation/up.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t object_count = 100;
constexpr double golden_angle = 2.399963229728653;  // radians; spreads directions evenly

struct Upright {
  double x, y, height;
};

Upright point_on_ground(std::size_t i, double share, double sensor_height) {
  const double distance = 2 + 50 * share, angle = golden_angle * static_cast<double>(i);
  return {distance * std::cos(angle), distance * std::sin(angle), -sensor_height};
}

// The points of an object follow a low-discrepancy sequence. If an object has 30 or more points, neighbours
// are nearer to each other than 0.5 m.
Upright point_on_object(std::size_t i, double sensor_height) {
  const std::size_t number_on_object = i / object_count;
  const auto object = static_cast<double>(i % object_count), n = static_cast<double>(number_on_object);
  const double distance = 6 + object / 3, angle = golden_angle * object;
  const double u = std::fmod(n * 0.7548776662466927, 1), v = std::fmod(n * 0.5698402909980532, 1);
  return {distance * std::cos(angle) + 2 * u, distance * std::sin(angle), 0.5 + 1.2 * v - sensor_height};
}

}  // namespace

Frame synthetic_sweep(std::size_t points, const PipelineConfig& config) {
  const Eigen::Vector3d up = normalized_up(config.ground.up);
  const Eigen::Vector3d side = up.unitOrthogonal(), ahead = up.cross(side);
  const double sensor_height = config.ground.sensor_height.value_or(1.7);
  const auto xyz = std::make_shared<std::vector<float>>();
  xyz->reserve(3 * points);
  for (std::size_t i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points);
    const Upright at =
        i % 2 == 0 ? point_on_ground(i, share, sensor_height) : point_on_object(i / 2, sensor_height);
    const Eigen::Vector3d p = at.x * side + at.y * ahead + at.height * up;
    xyz->insert(xyz->end(),
                {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  Frame frame;
  frame.points = PointView::of(xyz->data(), 3 * sizeof(float), points);
  frame.owner = xyz;
  if (config.cluster.class_field) frame.classes = std::make_shared<std::vector<std::int64_t>>(points, 0);
  return frame;
}

}  // namespace pcl_bv::detail
