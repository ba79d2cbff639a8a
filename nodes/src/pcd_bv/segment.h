// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// From a cloud to the sets of points that volumes are fitted around.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "options.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/kernels/point_source.h"
#include "pcl_bv/segmentation/euclidean_clusters.h"

namespace pcl_bv {

/// The entries of one cloud. Views the cloud's points and its own lists.
struct Segmentation {
  PointView in_range;                           ///< What passed the range filter.
  PointView points;                             ///< Of it, what is no ground.
  std::unique_ptr<const PointSource> filtered;  ///< Of in_range, if a filter is all that there is to do.
  std::vector<std::int32_t> in_range_numbers;   ///< Else the point numbers of in_range.
  std::vector<std::int32_t> above_ground;       ///< Point numbers of points, if ground was looked for.
  std::vector<std::int32_t> ground;             ///< Point numbers of the ground.
  Clusters clusters;                            ///< If clustering was asked.
  std::vector<PointView> entries;               ///< Of each entry, in order of the ids.
  Counts counts;  ///< Without any of these steps nobody has looked at the points yet: `nonfinite` is 0.
};

/// Whether points have to be told apart, for which all of them must be in memory.
bool tells_points_apart(const Options& options);

/// A cloud of a source must not need to be told apart.
Segmentation segment(const PointView& cloud, const Options& options);

/// Whether some step of segment() looks at each point, and so counts those that are not finite.
bool looks_at_points(const Options& options);

/// For each of the cloud's points the id of its entry, label_ground, or label_none.
std::vector<std::uint32_t> labels(const Segmentation& segmentation, std::size_t cloud_size);

}  // namespace pcl_bv
