// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "object_texts.h"

#include "pcl_bv/report/cluster_json.h"
#include "pipeline/config/settings.h"
#include "pipeline/ground.h"

namespace pcl_bv::detail {
namespace {

// Texts of components whose objects are dropped because of their extent.
constexpr const char* kSmall = "small";
constexpr const char* kLarge = "large";

}  // namespace

std::string ground_text(const GroundConfig& config) {
  const GroundSlopeOptions options = slope_settings(config);
  return "--ground slope --ground-cell " + to_text(options.cell_size) + " --ground-slope " +
         to_text(options.max_slope_degrees) + " --ground-distance " + to_text(options.distance) + " --up " +
         to_text(options.up);
}

std::string clusters_text(const PipelineConfig& config) {
  std::string text = "--cluster " + to_text(config.cluster.tolerance) + " --min-points " +
                     to_text(config.cluster.min_points);
  if (config.ground.method == GroundMethod::slope) text += ' ' + ground_text(config.ground);
  if (!config.cluster.class_field) return text;
  text += " --class " + config.cluster.class_field->name;
  const ClassTable table(config);
  for (const ClassOptions& one : table.class_options()) {
    text += " " + std::to_string(one.value) + ": ";
    text += one.drop ? "drop" : to_text(one.clusters.tolerance) + "," + to_text(one.clusters.min_points);
  }
  return text;
}

std::string volumes_text(const PipelineConfig& config, const ClassTable& table,
                         std::optional<std::int64_t> value) {
  const MethodOptions options = config.method_options();
  std::string text;
  for (const Method* method : table.methods_of(value))
    text.append(method->name).append(" ");
  return text + to_text(options.growth) + ' ' + to_text(options.up) + ' ' + to_text(options.concave_length) +
         ' ' + to_text(config.cluster.min_extent) + ' ' + to_text(config.cluster.max_extent);
}

std::string text_of(const Object& object) {
  if (object.verdict == ExtentVerdict::small) return kSmall;
  if (object.verdict == ExtentVerdict::large) return kLarge;
  return cluster_json(object.entry);
}

Object object_of(const std::string& text) {
  Object object;
  if (text == kSmall) {
    object.verdict = ExtentVerdict::small;
  } else if (text == kLarge) {
    object.verdict = ExtentVerdict::large;
  } else {
    object.entry = read_cluster_json(text);
  }
  return object;
}

}  // namespace pcl_bv::detail
