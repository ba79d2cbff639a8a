// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/any_volume.h"

#include <array>

namespace pcl_bv {
bool empty(const AnyVolume& volume) {
  return std::visit([](const auto& v) { return v.empty(); }, volume);
}

bool contains(const AnyVolume& volume, const Eigen::Vector3d& point) {
  return std::visit([&](const auto& v) { return v.contains(point); }, volume);
}

double volume(const AnyVolume& volume) {
  return std::visit([](const auto& v) { return v.volume(); }, volume);
}

double surface_area(const AnyVolume& volume) {
  return std::visit([](const auto& v) { return v.surface_area(); }, volume);
}

Eigen::Vector3d center(const AnyVolume& volume) {
  return std::visit([](const auto& v) -> Eigen::Vector3d { return v.center(); }, volume);
}

Eigen::Vector3d support(const AnyVolume& volume, const Eigen::Vector3d& direction) {
  return std::visit([&](const auto& v) -> Eigen::Vector3d { return v.support(direction); }, volume);
}

double distance(const AnyVolume& volume, const Eigen::Vector3d& point) {
  return std::visit([&](const auto& v) { return v.distance(point); }, volume);
}

std::optional<RayInterval> intersect(const AnyVolume& volume, const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction) {
  return std::visit([&](const auto& v) { return v.intersect(origin, direction); }, volume);
}

Aabb aabb(const AnyVolume& volume) {
  return std::visit([](const auto& v) { return v.aabb(); }, volume);
}

Mesh mesh(const AnyVolume& volume) {
  return std::visit([](const auto& v) { return v.mesh(); }, volume);
}

AnyVolume transformed(const AnyVolume& volume, const Eigen::Isometry3d& transform) {
  return std::visit([&](const auto& v) -> AnyVolume { return v.transformed(transform); }, volume);
}

std::string_view shape_name(const AnyVolume& volume) {
  static constexpr std::array<std::string_view, std::variant_size_v<AnyVolume>> kNames = {
      "aabb", "kdop", "sphere", "obb", "cylinder", "capsule", "ellipsoid", "hull", "prism"};
  return kNames.at(volume.index());
}

}  // namespace pcl_bv
