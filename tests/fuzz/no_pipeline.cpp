// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A pipeline that only keeps its settings, and methods by their names: what reading settings calls.
#include <stdexcept>
#include <utility>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/nodes/frame_pipeline.h"

namespace pcl_bv {

struct FramePipeline::State {
  PipelineConfig config;
};
FramePipeline::FramePipeline(PipelineConfig config) : state_(new State{std::move(config)}) {}
FramePipeline::~FramePipeline() = default;
void FramePipeline::set_config(PipelineConfig config) {
  const std::vector<std::string> problems = config.validate();
  if (!problems.empty()) throw std::invalid_argument(problems.front());
  state_->config = std::move(config);
}
PipelineConfig FramePipeline::config() const {
  return state_->config;
}

const std::vector<Method>& methods() {
  static const std::vector<Method> known = [] {
    std::vector<Method> two(2);
    two[0].name = "aabb";
    two[1].name = "hull";
    return two;
  }();
  return known;
}
const std::vector<const Method*>& methods_of_all() {
  static const std::vector<const Method*> all{&methods()[0]};
  return all;
}
const Method* find_method(std::string_view name) {
  for (const Method& method : methods())
    if (method.name == name) return &method;
  return nullptr;
}

}  // namespace pcl_bv
