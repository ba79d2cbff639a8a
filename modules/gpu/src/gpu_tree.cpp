// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/gpu/gpu_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "device_tree.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/trees/argument_checks.h"
#include "tree_queries.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Above the squared distances of all points that the device searches, and finite as a float.
constexpr double kNoLimit = 0x1p117;

// Queries that a thread runs at a time on the tree in memory.
constexpr std::size_t kBlock = 256;

// The queries that the processor has to run.
class Leftovers {
 public:
  explicit Leftovers(std::size_t count) : marked_(count, 0) {}

  // Returns a query without candidates.
  DeviceQuery mark(std::size_t i) {
    marked_[i] = 1;
    return {};
  }

  // Calls run(tree, i) for the marked queries, in parallel.
  template <typename Run>
  void for_each(const DeviceTree& tree, const Execution& execution, const Run& run) const {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < marked_.size(); ++i) {
      if (marked_[i] != 0) numbers.push_back(i);
    }
    if (numbers.empty()) return;
    const PointTree& on_host = tree.on_host(execution);
    for_each_range(execution.parallel, numbers.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n)
        run(on_host, numbers[n]);
    });
  }

 private:
  std::vector<std::uint8_t> marked_;
};

// As Neighbor defines it.
double squared_distance(const Candidate& point, const Coordinates& from) {
  const double x = point.x - from.x, y = point.y - from.y, z = point.z - from.z;
  return x * x + y * y + z * z;
}

std::int32_t index_of(const PointView& points, const TreePart& part, const Candidate& point) {
  return static_cast<std::int32_t>(points.index(part.first + point.number));
}

Coordinates coordinates_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

// Returns the query for the points whose squared distance is at most `limit`.
std::optional<DeviceQuery> ball_query(const DeviceTree& tree, const Coordinates& center, double limit) {
  std::optional<DeviceQuery> query = query_at(tree, center, 0);
  if (!query) return query;
  query->limit = float_up(std::min(limit, kNoLimit));
  query->inside = float_down(std::min(limit, kNoLimit));
  return query;
}

void require_radius(const MovingSphere& sphere) {
  if (!(sphere.radius >= 0 && sphere.radius <= kMaxCoordinate))
    throw_out_of_range_value("GpuTree: the radius of a moving sphere must be from 0 to 1e100", sphere.radius);
}

// Returns the query of a moving sphere, or nothing if the processor must run it.
std::optional<DeviceQuery> sweep_query(const DeviceTree& tree, const MovingSphere& sphere) {
  const double length = sphere.direction.lpNorm<Eigen::Infinity>();
  // For other lengths, the parameters of different points can be rounded to the same number.
  if (!(length > 0x1p-900 && length < 0x1p900)) return std::nullopt;
  std::optional<DeviceQuery> query = query_at(tree, coordinates_of(sphere.origin), sphere.radius);
  if (!query) return query;
  const Eigen::Vector3d unit = (sphere.direction / length).normalized();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    query->direction[axis] = static_cast<float>(unit[axis]);
  query->limit = 0x1p60F;
  return query;
}

bool precedes(const PointHit& a, const PointHit& b) {
  return a.t < b.t || (a.t == b.t && a.index < b.index);
}

}  // namespace

GpuTree::GpuTree(const GpuCloud& cloud) {
  const FloatEnvironment environment;
  tree_ = std::make_unique<DeviceTree>(cloud);
}
GpuTree::~GpuTree() = default;
GpuTree::GpuTree(GpuTree&&) noexcept = default;
GpuTree& GpuTree::operator=(GpuTree&&) noexcept = default;

void GpuTree::refit(const GpuCloud& cloud) {
  const FloatEnvironment environment;
  tree_->refit(cloud);
}

std::size_t GpuTree::size() const {
  return tree_->size();
}

std::size_t GpuTree::dropped() const {
  return tree_->dropped();
}

void nearest(const GpuTree& tree, const PointView& query_points, std::vector<Neighbor>& found,
             double max_distance, const Execution& execution) {
  if (query_points.source != nullptr)
    throw std::invalid_argument("GpuTree: the query points must be in memory");
  require_distance("GpuTree", max_distance);
  const FloatEnvironment environment;
  const DeviceTree& on_device = tree.on_device();
  const PointView points = on_device.cloud().points();
  const double limit = max_distance * max_distance;
  const Neighbor none{-1, kInfinity};
  found.assign(query_points.count, none);
  Leftovers leftovers(found.size());
  const auto make = [&](std::size_t i) {
    const Coordinates position = load_point(query_points, i);
    if (!is_valid(position)) return DeviceQuery();
    const std::optional<DeviceQuery> query = ball_query(on_device, position, limit);
    return query ? *query : leftovers.mark(i);
  };
  const auto take = [&](std::size_t i, const TreePart& part, const DeviceResult& result) {
    if (result.candidates == DeviceResult::kMany) {
      leftovers.mark(i);
      return;
    }
    const Coordinates position = load_point(query_points, i);
    for (std::size_t c = 0; c < result.candidates; ++c) {
      const Candidate& point = result.found[c];
      const Neighbor candidate{index_of(points, part, point), squared_distance(point, position)};
      if (candidate.squared_distance <= limit && candidate < found[i]) found[i] = candidate;
    }
  };
  run_queries(on_device, QueryKind::nearest, found.size(), execution, make, take);
  leftovers.for_each(on_device, execution, [&](const PointTree& on_host, std::size_t i) {
    const Coordinates position = load_point(query_points, i);
    found[i] = on_host.nearest({position.x, position.y, position.z}, max_distance).value_or(none);
  });
}

void any_inside(const GpuTree& tree, const std::vector<Sphere>& spheres, std::vector<std::uint8_t>& inside,
                const Execution& execution) {
  const FloatEnvironment environment;
  const DeviceTree& on_device = tree.on_device();
  inside.assign(spheres.size(), 0);
  Leftovers leftovers(spheres.size());
  const auto make = [&](std::size_t i) {
    const Sphere& sphere = spheres[i];
    if (sphere.empty()) return DeviceQuery();
    const std::optional<DeviceQuery> query =
        ball_query(on_device, coordinates_of(sphere.center()), sphere.max_squared_distance());
    return query ? *query : leftovers.mark(i);
  };
  const auto take = [&](std::size_t i, const TreePart&, const DeviceResult& result) {
    if (result.candidates == DeviceResult::kCertainly) {
      inside[i] = 1;
    } else if (result.candidates == DeviceResult::kMany) {
      leftovers.mark(i);
    } else {
      const Coordinates center = coordinates_of(spheres[i].center());
      for (std::size_t c = 0; c < result.candidates; ++c) {
        if (squared_distance(result.found[c], center) <= spheres[i].max_squared_distance()) inside[i] = 1;
      }
    }
  };
  run_queries(on_device, QueryKind::any, spheres.size(), execution, make, take);
  leftovers.for_each(on_device, execution, [&](const PointTree& on_host, std::size_t i) {
    inside[i] = static_cast<std::uint8_t>(on_host.any_inside(spheres[i]));
  });
}

void first_hit(const GpuTree& tree, const std::vector<MovingSphere>& spheres,
               std::vector<std::optional<PointHit>>& found, const Execution& execution) {
  const FloatEnvironment environment;
  std::for_each(spheres.begin(), spheres.end(), require_radius);
  const DeviceTree& on_device = tree.on_device();
  const PointView points = on_device.cloud().points();
  found.assign(spheres.size(), std::nullopt);
  Leftovers leftovers(spheres.size());
  const auto make = [&](std::size_t i) {
    const MovingSphere& sphere = spheres[i];
    if (!sphere.origin.allFinite() || !sphere.direction.allFinite()) return DeviceQuery();
    const std::optional<DeviceQuery> query = sweep_query(on_device, sphere);
    return query ? *query : leftovers.mark(i);
  };
  const auto take = [&](std::size_t i, const TreePart& part, const DeviceResult& result) {
    if (result.candidates == DeviceResult::kMany) {
      leftovers.mark(i);
      return;
    }
    for (std::size_t c = 0; c < result.candidates; ++c) {
      const Candidate& point = result.found[c];
      const auto touched = Sphere({point.x, point.y, point.z}, spheres[i].radius)
                               .intersect(spheres[i].origin, spheres[i].direction);
      if (!touched) continue;
      const PointHit hit{index_of(points, part, point), touched->enter};
      if (!found[i] || precedes(hit, *found[i])) found[i] = hit;
    }
  };
  run_queries(on_device, QueryKind::first_hit, spheres.size(), execution, make, take);
  leftovers.for_each(on_device, execution, [&](const PointTree& on_host, std::size_t i) {
    const MovingSphere& sphere = spheres[i];
    found[i] = on_host.first_hit(sphere.origin, sphere.direction, sphere.radius);
  });
}

}  // namespace pcl_bv
