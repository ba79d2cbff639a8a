// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/segmentation/class_clusters.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// The cluster options and methods of a configuration, resolved for each class.
class ClassTable {
 public:
  ClassTable() = default;
  explicit ClassTable(const PipelineConfig& config);

  /// Returns a table whose growing tolerances are measured from `origin`.
  ClassTable with_origin(const Eigen::Vector3d& origin) const;

  /// Returns the options for classes that have no ClassConfig.
  const ClusterOptions& default_options() const { return default_options_; }
  /// Returns the options of each class that has a ClassConfig.
  const std::vector<ClassOptions>& class_options() const { return class_options_; }

  /// Returns the methods for objects of the class `value`. nullopt means that points have no classes.
  const std::vector<const Method*>& methods_of(std::optional<std::int64_t> value) const;

 private:
  ClusterOptions default_options_;
  std::vector<ClassOptions> class_options_;
  std::vector<const Method*> default_methods_;
  std::vector<std::vector<const Method*>> class_methods_;  // in the order of `class_options_`
};

}  // namespace detail
}  // namespace pcl_bv
