// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "check.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/io/untrusted_text.h"
#include "rows.h"
#include "settings.h"
#include "stream/rig/mounting_pose.h"

namespace pcl_bv {
using namespace detail;
namespace {

std::string known_methods() {
  std::string names;
  for (const Method& method : methods())
    names += (names.empty() ? "" : ", ") + std::string(method.name);
  return names;
}

template <ConfigRow Row>
std::string problem_of_row(const Row& row) {
  std::string problem;
  visit_row(row, [&](const Setting& field, const auto& value) {
    const std::string what = problem_of(field, value);
    if (problem.empty() && !what.empty()) problem = std::string(field.key) + ": " + what;
  });
  return problem;
}

struct SideOfSize {
  const char* name;
  double UprightSize::*length;
};
constexpr SideOfSize kSides[] = {
    {"along", &UprightSize::along}, {"across", &UprightSize::across}, {"up", &UprightSize::up}};

void check_extents(const ClusterConfig& c, const SettingName& name, std::vector<ConfigProblem>& problems) {
  const auto add = [&](const char* key, const std::string& what) { problems.push_back({key, what}); };
  if (c.tolerance == 0 && (c.min_extent || c.max_extent))
    add(c.min_extent ? "cluster.min_extent" : "cluster.max_extent",
        "needs a " + name("cluster.tolerance") + " above 0: with 0, all points are one object");
  if (!c.min_extent || !c.max_extent) return;
  for (const SideOfSize& side : kSides) {
    const double min = *c.min_extent.*side.length, max = *c.max_extent.*side.length;
    if (max < min)
      add("cluster.max_extent", std::string(side.name) + ": " + to_text(max) + " is below " +
                                    name("cluster.min_extent") + ", " + to_text(min));
  }
}

void check_classes(const ClusterConfig& all, const SettingName& name, std::vector<ConfigProblem>& problems) {
  const auto add = [&](const std::string& what) { problems.push_back({"cluster.classes", what}); };
  if (!all.classes.empty() && !all.class_field) add("needs " + name("cluster.class_field"));
  for (const ClassConfig& own : all.classes) {
    const std::string which = "class " + std::to_string(own.value) + ": ";
    const std::size_t min = own.min_size.value_or(all.effective_min_size()),
                      max = own.max_size.value_or(all.max_size);
    if (min > max) add(which + "max_size, " + to_text(max) + ", is below min_size, " + to_text(min));
  }
}

void check_combinations(const PipelineConfig& c, const SettingName& name,
                        std::vector<ConfigProblem>& problems) {
  const auto add = [&](const char* key, const std::string& what) { problems.push_back({key, what}); };
  const FilterConfig& filter = c.filter;
  if (filter.range_min > filter.range_max) {
    add("filter.range_max", to_text(filter.range_max) + " is below " + name("filter.range_min") + ", " +
                                to_text(filter.range_min));
  }
  if (filter.own_box_min.has_value() != filter.own_box_max.has_value()) {
    add(filter.own_box_min ? "filter.own_box_min" : "filter.own_box_max",
        "is set without the other corner: set both or none");
  } else if (filter.own_box_min && !(filter.own_box_min->array() <= filter.own_box_max->array()).all()) {
    add("filter.own_box_max", "is below " + name("filter.own_box_min"));
  }
  if (c.cluster.tolerance_per_metre > 0) {
    const std::string if_it_grows = " if " + name("cluster.tolerance_per_metre") + " is above 0";
    if (c.cluster.min_points > 1)
      add("cluster.min_points", to_text(c.cluster.min_points) + " is not allowed: must be 1" + if_it_grows);
    if (c.cluster.tolerance == 0) add("cluster.tolerance", "0 is not allowed: must be above 0" + if_it_grows);
  }
  if (c.cluster.class_field && c.cluster.tolerance == 0)
    add("cluster.class_field",
        "needs a " + name("cluster.tolerance") + " above 0: with 0, all points are one object");
  if (c.cluster.effective_min_size() > c.cluster.max_size) {
    add("cluster.max_size", to_text(c.cluster.max_size) + " is below " + name("cluster.min_size") + ", " +
                                to_text(c.cluster.effective_min_size()));
  }
  check_extents(c.cluster, name, problems);
  check_classes(c.cluster, name, problems);
}

std::vector<std::string> lines(const std::vector<ConfigProblem>& problems) {
  std::vector<std::string> texts;
  texts.reserve(problems.size());
  for (const ConfigProblem& problem : problems)
    texts.push_back(message_line(problem.key + ": " + problem.what));
  return texts;
}

// Returns a visitor that adds the problem of each visited setting to `problems`.
auto checker(std::vector<ConfigProblem>& problems) {
  return [&](const Setting& setting, const auto& value) {
    std::string problem = problem_of(setting, value);
    if (!problem.empty()) problems.push_back({std::string(setting.key), std::move(problem)});
  };
}

}  // namespace

NumberRange detail::range_of(std::string_view key) {
  std::optional<NumberRange> range;
  const PipelineConfig any;
  visit_pipeline(any, [&](const Setting& setting, const auto&) {
    if (setting.key == key) range = setting.range;
  });
  if (!range) throw std::logic_error("range_of: no setting is named " + std::string(key));
  return *range;
}

std::string detail::problem_of(const Setting& setting, double value) {
  const auto& [min, max, closed, as_float] = setting.range;
  const bool vanishes = as_float && value > 0 && static_cast<float>(value) == 0;
  if (vanishes)
    return to_text(value) + " is too small: it becomes 0 as float32, the type of points; use " +
           (closed ? "0, or " : "") + "at least 1.4e-45";
  if ((closed ? value >= min : value > min) && value <= max) return {};  // false for NaN
  std::string allowed = (closed ? " is not at least " : " is not above ") + to_text(min);
  if (max < kFinite) allowed += " and at most " + to_text(max);
  if (max == kFinite) allowed += " and finite";
  return to_text(value) + allowed;
}

std::string detail::whole_number_range(const NumberRange& range) {
  std::string allowed = " of at least " + to_text(static_cast<std::size_t>(range.min));
  if (range.max < kFinite) allowed += " and at most " + to_text(static_cast<std::size_t>(range.max));
  return allowed;
}

std::string detail::problem_of(const Setting& setting, std::size_t value) {
  const double min = setting.range.min, max = setting.range.max;
  const auto n = static_cast<double>(value);
  if (n >= min && (n <= max || max == kNoLimit)) return {};
  return to_text(value) + " is not a whole number" + whole_number_range(setting.range);
}

std::string detail::problem_of(const Setting& /*setting*/, const Eigen::Vector3d& direction) {
  if (direction.allFinite() && !direction.isZero(0)) return {};
  return to_text(direction) + " is no direction: three finite numbers, not all 0";
}

std::string detail::problem_of(const Setting& setting, const std::string& text) {
  if (setting.key != "isa") return {};
  try {
    static_cast<void>(UsableIsa(parse_isa(text)));
  } catch (const std::invalid_argument& error) {
    return (text == "auto" ? "PCL_BV_ISA in the environment: " : "") + std::string(error.what());
  }
  return {};
}

std::string detail::problem_of(const Setting& /*setting*/, const std::vector<std::string>& methods) {
  for (auto name = methods.begin(); name != methods.end(); ++name) {
    const Method* const method = find_method(*name);
    if (method == nullptr) return "'" + *name + "' is no method; known are " + known_methods();
    const auto same = [&](const std::string& other) { return find_method(other) == method; };
    if (std::any_of(methods.begin(), name, same)) return "'" + *name + "' is named twice";
  }
  return {};
}

std::string detail::problem_of(const Setting& /*setting*/, const std::optional<Eigen::Vector3d>& point) {
  return point && !point->allFinite() ? "a coordinate is not finite" : "";
}

std::string detail::problem_of(const Setting& /*setting*/, const std::vector<RegionConfig>& regions) {
  for (const RegionConfig& region : regions) {
    if (region.file.empty() && region.volumes.empty()) return "a region has neither a file nor volumes";
    std::string problem = problem_of_row(region);
    if (!problem.empty()) return problem;
  }
  return {};
}

std::string detail::problem_of(const Setting& /*setting*/, const std::vector<ClassConfig>& classes) {
  std::set<std::int64_t> values;
  for (const ClassConfig& own : classes) {
    std::string name = "class " + std::to_string(own.value);
    if (!values.insert(own.value).second) return name + " is given twice";
    const std::string problem = problem_of_row(own);
    if (!problem.empty()) return name.append(": ").append(problem);
  }
  return {};
}

std::string detail::problem_of(const Setting& /*setting*/, const std::vector<RigSensor>& sensors) {
  std::set<std::pair<std::string, std::string>> topics;
  for (const RigSensor& sensor : sensors) {
    if (sensor.topic.empty()) return "a sensor has no topic";
    if (!topics.emplace(sensor.topic, sensor.source).second)
      return "topic " + sensor.topic + " is given twice";
    if (sensor.pose.empty() || mounting_pose(sensor.pose)) continue;
    return "the pose of " + sensor.topic +
           " is not x, y, z, roll, pitch, yaw, nor x, y, z and a quaternion x, y, z, w of length 1";
  }
  return {};
}

std::string detail::problem_of(const Setting& /*setting*/, const FieldName& field) {
  return field.name.empty() ? "the name of the field is empty" : "";
}

std::string detail::problem_of(const Setting& setting, const UprightSize& size) {
  std::string problem;
  for (const SideOfSize& side : kSides) {
    const std::string what = problem_of(setting, size.*side.length);
    if (problem.empty() && !what.empty()) problem = std::string(side.name) + ": " + what;
  }
  return problem;
}

std::vector<ConfigProblem> detail::problems_of(const PipelineConfig& config, const SettingName& name) {
  std::vector<ConfigProblem> problems;
  visit_pipeline(config, checker(problems));
  if (problems.empty()) check_combinations(config, name, problems);
  return problems;
}

std::vector<ConfigProblem> detail::problems_of(const RunnerConfig& config) {
  std::vector<ConfigProblem> problems;
  visit_runner(config, checker(problems));
  return problems;
}

std::vector<ConfigProblem> detail::problems_of(const RigConfig& rig, const SettingName& name) {
  std::vector<ConfigProblem> problems;
  visit_rig(rig, checker(problems));
  const auto need = [&](const char* key, bool set, bool given, const char* needed) {
    if (set && !given) problems.push_back({key, "needs " + name(needed)});
  };
  const bool merges = !rig.frame.empty();
  need("rig.fixed_frame", !rig.fixed_frame.empty(), merges, "rig.frame");
  need("rig.odometry", !rig.odometry.empty(), !rig.fixed_frame.empty(), "rig.fixed_frame");
  need("rig.urdf", !rig.urdf.empty(), merges, "rig.frame");
  need("rig.sensors", !rig.sensors.empty(), merges, "rig.frame");
  need("rig.self_filter", rig.self_filter.has_value(), !rig.urdf.empty(), "rig.urdf");
  return problems;
}

std::vector<ConfigProblem> detail::problems_of(const StreamConfig& config, const SettingName& name) {
  std::vector<ConfigProblem> problems = problems_of(config.pipeline, name);
  std::ranges::move(problems_of(config.runner), std::back_inserter(problems));
  std::ranges::move(problems_of(config.rig, name), std::back_inserter(problems));
  return problems;
}

void detail::throw_if_any(const std::vector<ConfigProblem>& problems) {
  std::string all;
  for (const std::string& line : lines(problems))
    all.append(all.empty() ? "" : "; ").append(line);
  if (!all.empty()) throw std::invalid_argument(all);
}

std::vector<std::string> PipelineConfig::validate() const {
  return lines(problems_of(*this));
}

std::vector<std::string> RigConfig::validate() const {
  return lines(problems_of(*this));
}

std::vector<std::string> StreamConfig::validate() const {
  return lines(problems_of(*this));
}

}  // namespace pcl_bv
