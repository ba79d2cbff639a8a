// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "class_table.h"

namespace pcl_bv::detail {
namespace {

ClusterOptions options_of(const ClusterConfig& config) {
  return {static_cast<float>(config.tolerance),
          config.effective_min_size(),
          config.max_size,
          config.min_points,
          static_cast<float>(config.tolerance_per_metre),
          config.oversized};
}

ClassOptions options_of(const ClassConfig& config, const ClusterOptions& defaults) {
  ClassOptions own{config.value, defaults, config.drop};
  if (config.tolerance) own.clusters.tolerance = static_cast<float>(*config.tolerance);
  own.clusters.min_size = config.min_size.value_or(defaults.min_size);
  own.clusters.max_size = config.max_size.value_or(defaults.max_size);
  return own;
}

}  // namespace

ClassTable::ClassTable(const PipelineConfig& config)
    : default_options_(options_of(config.cluster)), default_methods_(config.methods_of(nullptr)) {
  for (const ClassConfig& own : config.cluster.classes) {
    class_options_.push_back(options_of(own, default_options_));
    class_methods_.push_back(config.methods_of(&own));
  }
}

ClassTable ClassTable::with_origin(const Eigen::Vector3d& origin) const {
  ClassTable moved = *this;
  moved.default_options_.range_origin = origin;
  for (ClassOptions& own : moved.class_options_)
    own.clusters.range_origin = origin;
  return moved;
}

const std::vector<const Method*>& ClassTable::methods_of(std::optional<std::int64_t> value) const {
  for (std::size_t i = 0; i < class_options_.size(); ++i) {
    if (class_options_[i].value == value) return class_methods_[i];
  }
  return default_methods_;
}

}  // namespace pcl_bv::detail
