// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/point_tree.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "pcl_bv/trees/argument_checks.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "point_tree_state.h"
#include "vectors.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Number of queries that a thread takes at a time. 256 queries take about 20 us.
constexpr std::size_t kBlock = 256;

// Returns the largest useful number of threads, which is one per four blocks. Starting a thread takes about
// as long as four blocks of queries, so starting a thread for less work gains nothing.
std::size_t threads_for_queries(std::size_t count) {
  return count / (4 * kBlock);
}

// Calls query(begin, end) for blocks of the `count` queries, in parallel.
template <typename Query>
void query_blocks(std::size_t count, const Execution& execution, const Query& query) {
  for_each_range(limit_threads(execution.parallel, threads_for_queries(count)), count, kBlock,
                 [&](std::size_t begin, std::size_t end) {
                   query(begin, end);
                 });
}

void require_in_memory(const PointView& query_points) {
  if (query_points.source != nullptr)
    throw std::invalid_argument("PointTree: the query points must be in memory");
}

Eigen::Vector3d query_point(const PointView& query_points, std::size_t i) {
  return vector(load_point(query_points, i));
}

// Calls query(p, one) for each query point p. query() writes the neighbours of p to `one`. Concatenates these
// lists in `found`.
template <typename Query>
void list_for_each(const PointView& query_points, const Execution& execution, NeighborLists& found,
                   const Query& query) {
  require_in_memory(query_points);
  std::vector<std::vector<Neighbor>> blocks(query_points.count / kBlock + 1);
  found.first.assign(query_points.count + 1, 0);
  query_blocks(query_points.count, execution, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor>& block = blocks[begin / kBlock];
    std::vector<Neighbor> one;
    for (std::size_t i = begin; i < end; ++i) {
      query(query_point(query_points, i), one);
      found.first[i + 1] = one.size();
      block.insert(block.end(), one.begin(), one.end());
    }
  });
  std::partial_sum(found.first.begin(), found.first.end(), found.first.begin());
  found.neighbors.clear();
  found.neighbors.reserve(found.first.back());
  for (const std::vector<Neighbor>& block : blocks)
    found.neighbors.insert(found.neighbors.end(), block.begin(), block.end());
}

}  // namespace

// Calls the kernel directly. PointTree::nearest() would make a FloatEnvironment for each query, which takes
// an eighth of the time of a query.
void nearest(const PointTree& tree, const PointView& query_points, std::vector<Neighbor>& found,
             double max_distance, const Execution& execution) {
  require_in_memory(query_points);
  const Neighbor none{-1, std::numeric_limits<double>::infinity()};
  const double limit = square_limit(max_distance);
  found.assign(query_points.count, none);
  query_blocks(query_points.count, execution, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Coordinates point = load_point(query_points, i);
      if (is_valid(point))
        found[i] = find_nearest(execution.isa, packed_tree(tree), point, limit).value_or(none);
    }
  });
}

void nearest(const PointTree& tree, const PointView& query_points, std::size_t k, NeighborLists& found,
             double max_distance, const Execution& execution) {
  list_for_each(query_points, execution, found,
                [&](const Eigen::Vector3d& point, std::vector<Neighbor>& one) {
                  tree.nearest(point, k, one, max_distance);
                });
}

void near(const PointTree& tree, const PointView& query_points, double distance, NeighborLists& found,
          const Execution& execution) {
  list_for_each(query_points, execution, found,
                [&](const Eigen::Vector3d& point, std::vector<Neighbor>& one) {
                  tree.near(point, distance, one);
                  std::sort(one.begin(), one.end());
                });
}

void any_inside(const PointTree& tree, const std::vector<Sphere>& spheres, std::vector<std::uint8_t>& inside,
                const Execution& execution) {
  inside.resize(spheres.size());
  query_blocks(spheres.size(), execution, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Sphere& sphere = spheres[i];
      inside[i] = static_cast<std::uint8_t>(!sphere.empty() && any_in_ball(execution.isa, packed_tree(tree),
                                                                           coordinates(sphere.center()),
                                                                           sphere.max_squared_distance()));
    }
  });
}

void any_inside(const PointTree& tree, const std::vector<AnyVolume>& volumes,
                std::vector<std::uint8_t>& inside, const Execution& execution) {
  inside.resize(volumes.size());
  query_blocks(volumes.size(), execution, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      inside[i] = static_cast<std::uint8_t>(tree.any_inside(volumes[i]));
  });
}

}  // namespace pcl_bv
