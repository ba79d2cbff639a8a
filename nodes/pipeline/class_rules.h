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

/// The cluster settings and methods of a configuration, resolved for each class.
class ClassRules {
 public:
  ClassRules() = default;
  explicit ClassRules(const PipelineConfig& config);

  /// Returns the settings for classes that have no ClassConfig.
  const ClusterSettings& default_settings() const { return default_settings_; }
  /// Returns the settings of each class that has a ClassConfig.
  const std::vector<ClassSettings>& class_settings() const { return class_settings_; }

  /// Returns the methods for objects of the class `value`. nullopt means that points have no classes.
  const std::vector<const Method*>& methods_of(std::optional<std::int64_t> value) const;

 private:
  ClusterSettings default_settings_;
  std::vector<ClassSettings> class_settings_;
  std::vector<const Method*> default_methods_;
  std::vector<std::vector<const Method*>> class_methods_;  // in the order of `class_settings_`
};

}  // namespace pcl_bv
