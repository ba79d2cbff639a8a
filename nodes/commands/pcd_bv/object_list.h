// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The objects of a cloud that can be larger than memory, from the clusters of one or several classes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <unordered_map>
#include <vector>

#include "object_fitter.h"
#include "options.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/segmentation/stored_clusters.h"
#include "status.h"

namespace pcl_bv::detail {

class ObjectList {
 public:
  ObjectList(const Options& options, Report& report) : options_(options), report_(report) {}

  /// Adds the objects of clusters, and counts the points of those that are dropped. Keeps the clusters if
  /// points or labels are to be written.
  void add(std::unique_ptr<StoredClusters> clusters, std::vector<Object> objects);

  /// Writes the objects to the report: the largest first, then by their first point, as those of a cloud in
  /// memory. To be called once.
  void write_report();

  /// Returns the labels of points as labels_of() does, without those of the ground.
  std::vector<std::uint32_t> labels(std::size_t first, std::size_t count) const;

  /// Returns the check sums of points of shares, as StoredClusters::check_sums().
  std::vector<std::uint32_t> check_sums(std::size_t first, std::size_t count) const;

  /// Writes the points of each object to a file.
  Status write_points(const std::filesystem::path& folder) const;

 private:
  const Options& options_;
  Report& report_;
  std::vector<std::unique_ptr<StoredClusters>> kept_;
  std::vector<Object> objects_;
  // For each cluster, the id of its object, or kLabelNone. If labels are to be written.
  std::unordered_map<const StoredClusters*, std::vector<std::uint32_t>> ids_;
};

}  // namespace pcl_bv::detail
