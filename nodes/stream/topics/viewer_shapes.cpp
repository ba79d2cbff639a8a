// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <iterator>

#include "pcl_bv/nodes/topics.h"
#include "pcl_bv/volumes/geometry.h"
#include "pcl_bv/volumes/shortest_rotation.h"

namespace pcl_bv {
namespace {

// Colours that differ from one another on dark and light backgrounds. They are translucent, so that the
// points inside remain visible.
constexpr std::array<float, 4> kColours[] = {{0.12F, 0.56F, 1, 0.5F},    {1, 0.5F, 0.05F, 0.5F},
                                             {0.17F, 0.7F, 0.17F, 0.5F}, {0.9F, 0.2F, 0.25F, 0.5F},
                                             {0.6F, 0.4F, 0.85F, 0.5F},  {0.75F, 0.6F, 0.1F, 0.5F},
                                             {0.1F, 0.75F, 0.75F, 0.5F}, {0.9F, 0.45F, 0.75F, 0.5F},
                                             {0.5F, 0.6F, 0.15F, 0.5F},  {0.55F, 0.35F, 0.3F, 0.5F}};

std::array<double, 3> array_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

VolumeShape solid(VolumeShape::Kind kind, const Eigen::Vector3d& center, const Eigen::Quaterniond& rotation,
                  const Eigen::Vector3d& size) {
  return {
      kind, array_of(center), {rotation.x(), rotation.y(), rotation.z(), rotation.w()}, array_of(size), {}};
}

// Returns the rotation from z to a unit axis. For a downward axis, z is first rotated to -z.
Eigen::Quaterniond rotation_to(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d up = axis.z() < 0 ? Eigen::Vector3d(-axis) : axis;
  const Eigen::Quaterniond rotation = detail::shortest_rotation(Eigen::Vector3d::UnitZ(), up);
  return axis.z() < 0 ? rotation * Eigen::Quaterniond(0, 1, 0, 0) : rotation;
}

// Returns the edges of the faces. An edge of two faces is returned once.
VolumeShape wires(const Mesh& mesh) {
  VolumeShape volume;
  volume.size = {1, 1, 1};
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const std::vector<std::int32_t>& face : mesh.faces) {
    for (std::size_t k = 0; k < face.size(); ++k)
      edges.insert(std::minmax(face[k], face[(k + 1) % face.size()]));
  }
  for (const auto& [a, b] : edges) {
    volume.line_points.push_back(array_of(mesh.vertices[static_cast<std::size_t>(a)]));
    volume.line_points.push_back(array_of(mesh.vertices[static_cast<std::size_t>(b)]));
  }
  return volume;
}

struct Draw {
  using Kind = VolumeShape::Kind;

  VolumeShape operator()(const Aabb& box) const {
    return solid(Kind::cube, box.center(), Eigen::Quaterniond::Identity(), box.max() - box.min());
  }
  VolumeShape operator()(const Obb& box) const {
    return solid(Kind::cube, box.center(), box.quaternion(), 2 * box.half_extents());
  }
  VolumeShape operator()(const Sphere& sphere) const {
    return solid(Kind::sphere, sphere.center(), Eigen::Quaterniond::Identity(),
                 Eigen::Vector3d::Constant(2 * sphere.radius()));
  }
  VolumeShape operator()(const Ellipsoid& ellipsoid) const {
    Eigen::Matrix3d axes = ellipsoid.axes();
    if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
    return solid(Kind::sphere, ellipsoid.center(), Eigen::Quaterniond(axes).normalized(),
                 2 * ellipsoid.radii());
  }
  VolumeShape operator()(const Cylinder& cylinder) const {
    return solid(Kind::cylinder, cylinder.center(), rotation_to(cylinder.axis()),
                 {2 * cylinder.radius(), 2 * cylinder.radius(), 2 * cylinder.half_height()});
  }
  template <class Volume>
  VolumeShape operator()(const Volume& volume) const {
    return wires(volume.mesh());
  }
};

}  // namespace

VolumeShape viewer_shape(const AnyVolume& volume) {
  return empty(volume) ? VolumeShape() : std::visit(Draw{}, volume);
}

std::vector<VolumeShape> viewer_shapes(const FrameResult& result) {
  std::vector<VolumeShape> volumes;
  volumes.reserve(result.volumes.size());
  for (std::size_t i = 0; i < result.clusters.size(); ++i) {
    for (std::size_t m = 0; m < result.methods.size(); ++m)
      volumes.push_back(result.is_requested(i, m) ? viewer_shape(result.volume(i, m)) : VolumeShape());
  }
  return volumes;
}

VolumeShape box_of(const FrameResult& result, std::size_t cluster) {
  const AnyVolume* first = nullptr;
  for (std::size_t m = 0; m < result.methods.size(); ++m) {
    const AnyVolume& volume = result.volume(cluster, m);
    if (!result.is_requested(cluster, m) || empty(volume)) continue;
    if (std::holds_alternative<Aabb>(volume) || std::holds_alternative<Obb>(volume))
      return viewer_shape(volume);
    if (first == nullptr) first = &volume;
  }
  return first == nullptr ? VolumeShape() : viewer_shape(AnyVolume(aabb(*first)));
}

std::array<float, 4> colour_of(const FrameResult& result, std::size_t cluster) {
  const TrackEntry* const track = result.track_of(cluster);
  return kColours[(track != nullptr ? track->id : cluster) % std::size(kColours)];
}

std::string object_id(const FrameResult& result, std::size_t cluster) {
  if (const TrackEntry* const track = result.track_of(cluster)) return std::to_string(track->id);
  return "cluster " + std::to_string(cluster);
}

std::set<std::pair<std::string, std::int32_t>> ShownObjects::replace(
    std::set<std::pair<std::string, std::int32_t>> now) {
  std::set<std::pair<std::string, std::int32_t>> ended;
  std::set_difference(shown_.begin(), shown_.end(), now.begin(), now.end(),
                      std::inserter(ended, ended.end()));
  shown_ = std::move(now);
  return ended;
}

}  // namespace pcl_bv
