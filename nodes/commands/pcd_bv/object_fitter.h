// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits volumes to the clusters of clouds that can be larger than memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "options.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/segmentation/stored_clusters.h"
#include "pipeline/class_table.h"
#include "pipeline/extent_limits.h"

namespace pcl_bv::detail {

/// Returns how StoredClusters may use memory. `scalar` is the type of the points.
StoredClusterOptions store_options(const Options& options, ScalarType scalar);

/// A cluster with its volumes, or why it is dropped.
struct Object {
  ExtentVerdict verdict = ExtentVerdict::keep;
  ClusterEntry entry;
  std::size_t first_number = 0;  ///< Set by ObjectList: number of its first point in the cloud.
  /// Set by ObjectList: the cluster, as long as the StoredClusters live.
  const StoredClusters* clusters = nullptr;
  std::size_t cluster = 0;
};

class ObjectFitter {
 public:
  /// Fits the methods for objects of a class, or of points without classes.
  ObjectFitter(const Options& options, const ClassTable& table, std::optional<std::int64_t> class_value);

  /// Fits volumes to clusters while their points are in memory (StoredClusterOptions::visit).
  void visit(std::size_t brick, const std::vector<PointView>& clusters, const Execution& execution);

  /// Returns a visited object. To be called once for each.
  Object take(const StoredVisit& visit) { return std::move(visited_.at(visit.brick)[visit.number]); }

  /// Returns the objects of all clusters. To be called once.
  std::vector<Object> fit(const StoredClusters& clusters);

  /// Fits volumes to the points of one cluster.
  Object fit(const PointView& points, const Execution& execution) const;

 private:
  const Options& options_;
  std::optional<std::int64_t> class_value_;
  std::vector<const Method*> methods_;
  MethodOptions method_options_;
  Execution execution_;
  std::mutex mutex_;
  std::unordered_map<std::size_t, std::vector<Object>> visited_;  // by brick
};

/// Calls work(i, execution) for all clusters. Large clusters use all threads, one after another. Small ones
/// are distributed over the threads.
void for_each_cluster(const StoredClusters& clusters, const Execution& execution,
                      const std::function<void(std::size_t, const Execution&)>& work);

}  // namespace pcl_bv::detail
