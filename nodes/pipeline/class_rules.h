// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a configuration says of each class of points, looked up.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/segmentation/class_clusters.h"

namespace pcl_bv {

class ClassRules {
 public:
  ClassRules() = default;
  explicit ClassRules(const PipelineConfig& config);

  const ClusterSettings& others() const { return others_; }
  const std::vector<ClassSettings>& own() const { return own_; }

  /// Of the volumes of objects of this class; nullopt: where points have no classes.
  const std::vector<const Method*>& methods_of(std::optional<std::int64_t> value) const;

 private:
  ClusterSettings others_;
  std::vector<ClassSettings> own_;
  std::vector<const Method*> other_methods_;
  std::vector<std::vector<const Method*>> own_methods_;  // as `own_`
};

}  // namespace pcl_bv
