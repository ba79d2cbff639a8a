// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <utility>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/trees/argument_checks.h"
#include "pcl_bv/volumes/pair_queries.h"
#include "vectors.h"
#include "volume_nodes.h"

namespace pcl_bv {
using namespace detail;
namespace {

bool is_before(const VolumeHit& a, const VolumeHit& b) {
  return std::pair(a.interval.enter, a.index) < std::pair(b.interval.enter, b.index);
}

bool is_before(const VolumeDistance& a, const VolumeDistance& b) {
  return std::pair(a.distance, a.index) < std::pair(b.distance, b.index);
}

std::uint32_t count_of(const std::vector<AnyVolume>& volumes) {
  return static_cast<std::uint32_t>(volumes.size());
}

// Calls visit(index) for all volumes. Used for points and rays that cannot be compared with boxes, because
// they are too far away or not finite.
template <typename Visit>
bool visit_all(const std::vector<AnyVolume>& volumes, const Visit& visit) {
  for (std::uint32_t index = 0; index < count_of(volumes); ++index) {
    if (visit(index)) return true;
  }
  return false;
}

template <typename Nodes, typename Visit>
bool visit_containing(const Nodes& nodes, const Eigen::Vector3d& point, const Visit& visit) {
  const auto visit_if_containing = [&](std::uint32_t index) {
    return contains(nodes.volumes[index], point) && visit(index);
  };
  return is_valid(coordinates(point)) ? nodes.visit_candidates_at(coordinates(point), visit_if_containing)
                                      : visit_all(nodes.volumes, visit_if_containing);
}

// Calls visit(index) for the volumes that a ray may hit and whose lower bound of t is at most limit(). t is
// the parameter of `origin + t * direction`. Some volumes are visited twice.
template <typename Nodes, typename Limit, typename Visit>
void visit_ray_candidates(const Nodes& nodes, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                          const Limit& limit, const Visit& visit) {
  const auto visit_one = [&](std::uint32_t index) {
    visit(index);
    return false;
  };
  if (!is_valid(coordinates(origin)) || !direction.allFinite()) {
    visit_all(nodes.volumes, visit_one);
    return;
  }
  if (direction.isZero(0)) {
    nodes.visit_candidates_at(coordinates(origin), visit_one);
    return;
  }
  const FrameRay ray(nodes.boxes, coordinates(origin), coordinates(direction));
  if (!ray.from.is_in_range()) {
    visit_all(nodes.volumes, visit_one);
    return;
  }
  for (const std::uint32_t index : nodes.boxes.without_box())
    visit(index);
  for (const std::uint32_t index : nodes.too_flat_for_rays)
    visit(index);
  const auto bound = [&](std::size_t group, std::size_t k) {
    return enter_box(ray, nodes.boxes.levels().groups[group], k);
  };
  nodes.nearest_first(
      bound, [&] { return ray.time(limit()); }, visit);
}

void sort_unique(std::vector<VolumeHit>& hits) {
  std::sort(hits.begin(), hits.end(),
            [](const VolumeHit& a, const VolumeHit& b) { return a.index < b.index; });
  hits.erase(std::unique(hits.begin(), hits.end(),
                         [](const VolumeHit& a, const VolumeHit& b) { return a.index == b.index; }),
             hits.end());
}

}  // namespace

bool VolumeTree::any_containing(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  return visit_containing(*nodes_, point, [](std::uint32_t) { return true; });
}

void VolumeTree::all_containing(const Eigen::Vector3d& point, std::vector<std::int32_t>& indices) const {
  const FloatEnvironment environment;
  indices.clear();
  visit_containing(*nodes_, point, [&](std::uint32_t index) {
    indices.push_back(static_cast<std::int32_t>(index));
    return false;
  });
  std::sort(indices.begin(), indices.end());
}

void VolumeTree::first_containing(const PointView& points, std::vector<std::int32_t>& first,
                                  const Execution& execution) const {
  first.resize(points.count);
  for_each_chunk(execution.parallel, chunk_count(points.count), [&](std::size_t chunk) {
    const LoadedPoints part = load_chunk(points, chunk);
    for (std::size_t i = 0; i < part.view().count; ++i) {
      std::int32_t& smallest = first[chunk * kChunkPoints + i];
      smallest = -1;
      visit_containing(*nodes_, vector(load_point(part.view(), i)), [&](std::uint32_t index) {
        const auto found = static_cast<std::int32_t>(index);
        if (smallest < 0 || found < smallest) smallest = found;
        return false;
      });
    }
  });
}

std::optional<VolumeHit> VolumeTree::first_hit(const Eigen::Vector3d& origin,
                                               const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  std::optional<VolumeHit> first;
  const auto limit = [&] { return first ? first->interval.enter : kInfinity; };
  visit_ray_candidates(*nodes_, origin, direction, limit, [&](std::uint32_t index) {
    const auto interval = intersect(nodes_->volumes[index], origin, direction);
    if (!interval) return;
    const VolumeHit hit = {static_cast<std::int32_t>(index), *interval};
    if (!first || is_before(hit, *first)) first = hit;
  });
  return first;
}

void VolumeTree::all_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                         std::vector<VolumeHit>& hits) const {
  const FloatEnvironment environment;
  hits.clear();
  visit_ray_candidates(
      *nodes_, origin, direction, [] { return kInfinity; },
      [&](std::uint32_t index) {
        const auto interval = intersect(nodes_->volumes[index], origin, direction);
        if (interval) hits.push_back({static_cast<std::int32_t>(index), *interval});
      });
  sort_unique(hits);
}

void VolumeTree::all_with_box_overlapping(const Aabb& box, std::vector<std::int32_t>& indices) const {
  const FloatEnvironment environment;
  indices.clear();
  if (box.empty()) return;
  nodes_->boxes.visit(nodes_->boxes.query(coordinates(box.min()), coordinates(box.max())),
                      [&](std::uint32_t index) {
                        if (aabb(nodes_->volumes[index]).overlaps(box))
                          indices.push_back(static_cast<std::int32_t>(index));
                        return false;
                      });
  std::sort(indices.begin(), indices.end());
}

void VolumeTree::all_overlapping(const AnyVolume& volume, std::vector<std::int32_t>& indices) const {
  const FloatEnvironment environment;
  indices.clear();
  if (empty(volume)) return;
  const ConvexBody body(volume);
  const PositionBounds extent = extent_of(volume);
  nodes_->boxes.visit(nodes_->boxes.query(extent.low, extent.high), [&](std::uint32_t index) {
    if (overlaps(ConvexBody(nodes_->volumes[index]), body))
      indices.push_back(static_cast<std::int32_t>(index));
    return false;
  });
  std::sort(indices.begin(), indices.end());
}

std::optional<VolumeDistance> VolumeTree::nearest(const Eigen::Vector3d& point, double max_distance) const {
  const FloatEnvironment environment;
  require_distance("VolumeTree", max_distance);
  std::optional<VolumeDistance> nearest;
  const auto visit = [&](std::uint32_t index) {
    if (empty(nodes_->volumes[index])) return false;
    const VolumeDistance found = {static_cast<std::int32_t>(index), distance(nodes_->volumes[index], point)};
    if (found.distance <= max_distance && (!nearest || is_before(found, *nearest))) nearest = found;
    return false;
  };
  const FramePoint query_point(nodes_->boxes, coordinates(point));
  if (!is_valid(coordinates(point)) || !query_point.is_in_range()) {
    visit_all(nodes_->volumes, visit);
    return nearest;
  }
  for (const std::uint32_t index : nodes_->boxes.without_box())
    visit(index);
  const double scale = nodes_->boxes.levels().scale;
  const auto bound = [&](std::size_t group, std::size_t k) {
    return distance_to_box(query_point, nodes_->boxes.levels().groups[group], k);
  };
  const auto limit = [&] { return (nearest ? nearest->distance : max_distance) * scale; };
  nodes_->nearest_first(bound, limit, visit);
  return nearest;
}

}  // namespace pcl_bv
