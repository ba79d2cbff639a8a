// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "shifted_points.h"

#include <cstring>
#include <limits>

#include "copy_points.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {

PointView ShiftedPoints::load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const {
  const LoadedPoints part(points_, first, count);
  constexpr std::size_t step = 3 * sizeof(double);
  if (buffer.size() < count * step) buffer.resize(count * step);
  for (std::size_t i = 0; i < count; ++i) {
    const Coordinates p = load_point(part.view(), i);
    const double shifted[3] = {p.x - origin_.x(), p.y - origin_.y(), p.z - origin_.z()};
    std::memcpy(buffer.data() + i * step, shifted, step);
  }
  return packed_points(buffer.data(), ScalarType::float64, count, first);
}

Eigen::Vector3d rounded_centre(const PointView& points, const Execution& execution) {
  const Aabb box = *fit_aabb(points, execution);
  return box.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.center().array().round());
}

Eigen::Vector3d recorded_origin(const std::optional<Eigen::Vector3d>& origin) {
  constexpr double farthest = 500;  // metres
  const bool near = origin && origin->array().abs().maxCoeff() <= farthest && origin->norm() <= farthest;
  return near ? Eigen::Vector3d(-*origin) : Eigen::Vector3d::Zero();
}

std::string origin_warning(const std::optional<Eigen::Vector3d>& origin, bool sensor_known,
                           const Options& options) {
  if (!origin || origin->isZero(0) || !recorded_origin(origin).isZero(0)) return {};
  const FilterConfig& filter = options.pipeline.filter;
  const GroundConfig& ground = options.pipeline.ground;
  std::string settings;
  const auto add = [&](bool used, const char* name) {
    if (used) settings.append(settings.empty() ? "" : ", ").append(name);
  };
  add(filter.range_min > 0 || filter.range_max < std::numeric_limits<double>::infinity(), "--range");
  add(filter.own_box_min || filter.own_box_max, "filter.own_box_min and own_box_max");
  add(options.pipeline.cluster.tolerance_per_metre > 0, "--cluster PER_METRE");
  add(ground.method == GroundMethod::zones && !ground.sensor && !sensor_known, "--ground zones");
  add(ground.method == GroundMethod::plane && ground.sensor_height, "--sensor-height");
  if (settings.empty()) return {};
  return "the sensor is assumed at the new origin (--origin), because 0,0,0 is more than 500 m from it; used "
         "by: " +
         settings;
}

std::vector<std::byte> packed_copy(const PointView& points) {
  const std::size_t step = 3 * size_of(points.scalar);
  std::vector<std::byte> all(step * points.count);
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk)
    copy_points(load_chunk(points, chunk).view(), points.scalar, all.data() + chunk * kChunkPoints * step);
  return all;
}

}  // namespace pcl_bv::detail
