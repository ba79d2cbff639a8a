// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits to clouds on a graphics card. The device rejects points that certainly do not matter, and the
// processor decides about the others, so every volume has the bits of the same fit without a device
// (docs/gpu.md).
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/gpu/gpu_cloud.h"
#include "pcl_bv/parallel/execution.h"

namespace [[gnu::visibility("default")]] pcl_bv {

namespace detail {
class ClusterFitter;
}

/// Fits several methods to the points of a cloud. Returns the fits in the order of `methods`. Volumes,
/// status, rank and counts have the same bits as those of fit_methods() for the points. Empty, flat and
/// invalid input gives what that function gives.
///
/// The device finds the support points of all methods that begin with them, in one pass: aabb, dop*,
/// sphere-*, and those that search the hull. For spheres of float points it also rejects points near the
/// centre. Everything else is done by the processor, which reads the points from GpuCloud::points(). The
/// processor also searches supports itself, so that the fit only takes longer, if more than a sixteenth of
/// the blocks of 1024 points could have a support (equal coordinates, as on a grid), or if coordinates span
/// more than 2^126.
///
/// Throws std::invalid_argument for a null method. Throws GpuError if the device has too little memory or is
/// lost. Exceptions of the source of the uploaded points are passed on.
std::vector<Fitted<AnyVolume>> fit(const GpuCloud& cloud, const std::vector<const Method*>& methods,
                                   const MethodOptions& options = {}, const Execution& execution = {});

/// The fits of several methods to each cluster of a cloud, stored without a copy of what k-DOPs have in
/// common.
class ClusterFits {
 public:
  std::size_t size() const { return results_.size(); }  ///< Number of clusters.

  /// Status, rank and counts of a cluster, which are the same for every method. O(1), without bounds checks.
  const EstimationResult& result(std::size_t cluster) const { return results_[cluster]; }

  /// Returns the fit of method number `method` of the list. Throws std::out_of_range for a cluster or a
  /// method that does not exist.
  Fitted<AnyVolume> fitted(std::size_t cluster, std::size_t method) const;

 private:
  friend class detail::ClusterFitter;

  std::vector<const Method*> methods_;
  std::vector<EstimationResult> results_;
  std::vector<std::size_t> directions_;  // of the stored slabs, in the order of the 26-DOP
  std::shared_ptr<double[]> slabs_;      // minimum and maximum along each direction, for each cluster
  // For each method its volumes, or none if they are made of slabs.
  std::vector<std::vector<AnyVolume>> others_;
};

/// Fits several methods to each cluster. Cluster i has the visited points of GpuCloud::points() from
/// offsets[i] up to offsets[i + 1], exclusive, or those whose indices are in list i. The fits have the same
/// bits as fit_methods() for the points of each cluster.
///
/// The device computes aabb and dop* of float points exactly, except for clusters of more than 32 768 points,
/// clusters that are not clearly solid, and coordinates whose bits span more than 60 powers of two. The
/// processor fits these clusters and all other methods. For lists, the cloud must be in one buffer
/// (GpuInfo::max_binding, 11 million points) and must have been made of points with an index from 0 on;
/// otherwise the processor fits all clusters.
///
/// Throws std::invalid_argument for a null method, for offsets that are empty or descend, and for lists of a
/// cloud that was not uploaded from memory or imported. Throws std::out_of_range for offsets and indices
/// beyond the cloud. Throws GpuError as fit() for a cloud does.
ClusterFits fit(const GpuCloud& cloud, const std::vector<std::size_t>& offsets,
                const std::vector<const Method*>& methods, const MethodOptions& options = {},
                const Execution& execution = {});
ClusterFits fit(const GpuCloud& cloud, const IndexLists& clusters, const std::vector<const Method*>& methods,
                const MethodOptions& options = {}, const Execution& execution = {});

}  // namespace pcl_bv
