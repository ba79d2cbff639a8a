// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "class_rules.h"

namespace pcl_bv {
namespace {

ClusterSettings settings_of(const ClusterConfig& config) {
  return {static_cast<float>(config.tolerance),
          config.effective_min_size(),
          config.max_size,
          config.min_points,
          static_cast<float>(config.tolerance_per_metre),
          config.oversized};
}

ClassSettings settings_of(const ClassConfig& config, const ClusterSettings& defaults) {
  ClassSettings own{config.value, defaults, config.drop};
  if (config.tolerance) own.clusters.tolerance = static_cast<float>(*config.tolerance);
  own.clusters.min_size = config.min_size.value_or(defaults.min_size);
  own.clusters.max_size = config.max_size.value_or(defaults.max_size);
  return own;
}

}  // namespace

ClassRules::ClassRules(const PipelineConfig& config)
    : default_settings_(settings_of(config.cluster)), default_methods_(config.methods_of(nullptr)) {
  for (const ClassConfig& own : config.cluster.classes) {
    class_settings_.push_back(settings_of(own, default_settings_));
    class_methods_.push_back(config.methods_of(&own));
  }
}

const std::vector<const Method*>& ClassRules::methods_of(std::optional<std::int64_t> value) const {
  for (std::size_t i = 0; i < class_settings_.size(); ++i) {
    if (class_settings_[i].value == value) return class_methods_[i];
  }
  return default_methods_;
}

}  // namespace pcl_bv
