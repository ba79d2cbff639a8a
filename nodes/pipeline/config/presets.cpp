// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "pcl_bv/nodes/stream_runner.h"
#include "pcl_bv/segmentation/up.h"

namespace pcl_bv {

std::vector<const Method*> PipelineConfig::methods_of(const ClassConfig* own) const {
  const std::vector<std::string>& names = own != nullptr && !own->volumes.empty() ? own->volumes : volumes;
  if (names.empty() && cluster.tolerance > 0) return {find_method("obb-lshape")};
  if (names.empty()) return {find_method("aabb"), find_method("sphere"), find_method("obb")};
  std::vector<const Method*> found;
  for (const std::string& name : names) {
    if (const Method* const method = find_method(name)) found.push_back(method);
  }
  return found;
}

std::vector<const Method*> PipelineConfig::methods() const {
  std::vector<const Method*> all = methods_of(nullptr);
  for (const ClassConfig& own : cluster.classes) {
    for (const Method* const method : methods_of(&own)) {
      if (std::find(all.begin(), all.end(), method) == all.end()) all.push_back(method);
    }
  }
  return all;
}

Execution PipelineConfig::execution() const {
  const UsableIsa instructions = parse_isa(isa);
  if (threads == 1) return {Serial{}, instructions};
  return {Threads{static_cast<unsigned>(threads)}, instructions};
}

MethodOptions PipelineConfig::method_options() const {
  return {growth, detail::normalized_up(ground.up),
          concave_length.value_or(std::numeric_limits<double>::infinity())};
}

Refine PipelineConfig::effective_refine() const {
  if (cluster.refine != Refine::automatic) return cluster.refine;
  return track.enabled ? Refine::tracks : Refine::off;
}

QueuePolicy resolved_policy(QueuePolicy policy, bool paced) {
  if (policy != QueuePolicy::automatic) return policy;
  return paced ? QueuePolicy::drop_oldest : QueuePolicy::block;
}

PipelineConfig whole_cloud_config() {
  PipelineConfig config;
  config.filter.range_min = 0;
  config.ground.method = GroundMethod::none;
  config.cluster.tolerance = 0;
  config.threads = 0;
  return config;
}

void apply_preset(std::string_view name, PipelineConfig& config) {
  FilterConfig filter;
  GroundConfig ground;
  ClusterConfig cluster;
  if (name == "indoor") {
    filter.range_min = 0.1;
    filter.range_max = 30;
    ground.method = GroundMethod::plane;
    ground.distance = 0.05;
    cluster.tolerance = 0.1;
    cluster.min_size = 50;
  } else if (name == "table") {
    filter.range_min = 0.2;
    filter.range_max = 2;
    ground.method = GroundMethod::plane;
    ground.up = {0, -1, -1};
    ground.distance = 0.01;
    ground.max_slope_degrees = 45;
    cluster.tolerance = 0.02;
    cluster.min_size = 100;
  } else if (name == "road") {
    cluster.tolerance_per_metre = 0.01;  // the rows of a far car are more than 0.5 m apart
  } else {
    throw std::invalid_argument("'" + std::string(name) + "' is not one of road, indoor, table");
  }
  config.filter = filter;
  config.ground = ground;
  config.cluster = cluster;
  config.track.vehicles = name == "road";
}

}  // namespace pcl_bv
