// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The pass over many clusters of a cloud on a device.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "device_points.h"
#include "pcl_bv/numeric/directions.h"

namespace pcl_bv::detail {

/// Clusters as the device reads them: ranges of points, or lists of indices.
struct DeviceClusters {
  std::vector<std::uint32_t> offsets;  ///< Where each cluster begins and the last one ends.
  const std::int32_t* indices;         ///< Null for ranges of points.

  std::size_t size() const { return offsets.size() - 1; }
};

/// The slabs of all clusters along the directions of a set.
struct ClusterSlabs {
  std::size_t directions = 0;
  /// For cluster c and direction k, elements 2 (c * directions + k) and the next one are the minimum and the
  /// maximum.
  std::shared_ptr<double[]> slabs;
  std::vector<std::uint32_t> valid;  ///< Number of valid points of each cluster.
  std::vector<std::uint8_t> found;   ///< Whether the slabs of a cluster are known, which then has rank 3.
};

/// Clusters with more points are not found.
inline constexpr std::size_t kLargestCluster = 32768;

/// Whether the device can read the clusters: it has the coordinates themselves and, for lists, all of them in
/// one buffer.
bool can_find_slabs(const DevicePoints& cloud, bool lists);

/// Finds the slabs of clusters. can_find_slabs() must be true. Throws GpuError.
ClusterSlabs find_slabs(const DevicePoints& cloud, const DeviceClusters& clusters, DirectionSet set,
                        const Execution& execution);

/// Returns an array whose elements have no value yet. That of 10^6 clusters has 208 MB, so it gets huge
/// pages: setting it to 0, or 51 000 faults of small pages, would take longer than everything else.
std::shared_ptr<double[]> make_slabs(std::size_t directions, std::size_t clusters);

}  // namespace pcl_bv::detail
