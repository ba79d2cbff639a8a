// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Distributes the points of a cloud to bricks.
#pragma once

#include <cstddef>
#include <vector>

#include "bricks.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/segmentation/clusters.h"
#include "pcl_bv/segmentation/stored_clusters.h"
#include "spill_file.h"

namespace pcl_bv::detail {

/// Side of the cells of bricks. A larger number makes fewer cells, with more points near their borders.
inline constexpr double kHalosPerCell = 16;

/// Text of the error if passes over the points find different ones.
inline constexpr char kPointsChanged[] = "the points have changed while they were read";

/// Throws std::invalid_argument for options that clusters of bricks do not have.
void check_stored(const ClusterOptions& options);

/// Returns the distance up to which a point can affect the result for other points.
double halo_of(const ClusterOptions& options, ScalarType scalar);

/// Returns the number of bricks that are clustered at the same time.
std::size_t bricks_at_a_time(const StoredClusterOptions& store, const ParallelPolicy& policy);

/// Divides the space into bricks, after all points were counted. `points` is their number.
void divide(std::size_t points, const StoredClusterOptions& store, const ParallelPolicy& policy,
            Bricks& bricks);

/// Returns the size of the blocks in which lists of that many bricks should be written.
std::size_t block_bytes(std::size_t bricks);

/// The valid points of a cloud in bricks.
struct DistributedPoints {
  Bricks bricks;
  std::vector<SpillList> lists;  ///< Records by brick, in the order of the cloud.
  std::size_t invalid = 0;       ///< Number of points that are not valid.
};

/// Takes two passes over the points.
DistributedPoints distribute(const PointView& points, const ClusterOptions& options,
                             const StoredClusterOptions& store, const Execution& execution, SpillFile& file);

}  // namespace pcl_bv::detail
