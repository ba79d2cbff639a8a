// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs many queries of a DeviceTree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "device_tree.h"
#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::detail {

/// What queries search for, as queries.comp numbers it.
enum class QueryKind : std::uint32_t { any, nearest, first_hit };

/// A query as queries.comp reads it, which explains the members. With limit < 0 it has no candidate.
struct DeviceQuery {
  float position[3] = {}, limit = -1;
  float direction[3] = {}, error = 0;
  float inside = -1, radius = 0;
  float unused[2] = {};
};

/// A point that can be the result.
struct Candidate {
  float x, y, z;
  std::uint32_t number;  ///< Of the point in its part.
};

/// The result for one part of the tree as queries.comp writes it.
struct DeviceResult {
  static constexpr std::uint32_t kMany = 0xfffffffe, kCertainly = 0xffffffff;

  std::uint32_t candidates, unused[3];
  Candidate found[4];
};

/// The largest sum of the coordinates and the radius for which the squares of the device are finite. The
/// processor runs queries with larger ones.
inline constexpr double kLargestOnDevice = 0x1p54;

/// Returns a query with its position, its error and its radius. Returns nothing if the coordinates of the
/// position or the tree, or the radius, are too large for the device.
std::optional<DeviceQuery> query_at(const DeviceTree& tree, const Coordinates& position, double radius);

/// Runs queries number 0 to count - 1. make(i) returns query i; several threads may call it. Then calls
/// take(i, part, result) for each query and each part of the tree, from one thread at a time for each query.
void run_queries(const DeviceTree& tree, QueryKind kind, std::size_t count, const Execution& execution,
                 const std::function<DeviceQuery(std::size_t)>& make,
                 const std::function<void(std::size_t, const TreePart&, const DeviceResult&)>& take);

}  // namespace pcl_bv::detail
