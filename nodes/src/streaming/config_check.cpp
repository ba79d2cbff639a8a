// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is allowed.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "config_fields.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/segmentation/up.h"

namespace pcl_bv {

std::string digits_of(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

namespace {

class Checker {
 public:
  explicit Checker(std::vector<ConfigProblem>& problems) : problems_(problems) {}

  void number(const char* key, double value, NumberRange range, const char*) {
    const bool above = range.closed ? value >= range.least : value > range.least;
    if (above && value <= range.most) return;  // false for NaN
    std::string allowed = range.closed ? " is not at least " : " is not above ";
    allowed += digits_of(range.least);
    if (range.most < std::numeric_limits<double>::max()) allowed += " and at most " + digits_of(range.most);
    if (range.most == std::numeric_limits<double>::max()) allowed += " and finite";
    add(key, digits_of(value) + allowed);
  }
  void optional_number(const char* key, const std::optional<double>& value, NumberRange range, const char*) {
    if (value) number(key, *value, range, "");
  }
  void whole(const char* key, std::size_t value, std::size_t least, std::size_t most, const char*) {
    if (value >= least && value <= most) return;
    std::string allowed = " is not a whole number of at least " + std::to_string(least);
    if (most != kUnlimited) allowed += " and at most " + std::to_string(most);
    add(key, std::to_string(value) + allowed);
  }
  void optional_point(const char* key, const std::optional<Eigen::Vector3d>& value, const char*) {
    if (value && !value->allFinite()) add(key, "a coordinate is not finite");
  }
  void direction(const char* key, const Eigen::Vector3d& up, const char*) {
    if (!up.allFinite() || up.isZero(0)) add(key, up_text(up) + " is not three finite numbers, not all 0");
  }
  template <typename Choice>
  void choice(const char*, Choice, const char*) {}
  void flag(const char*, bool) {}
  void methods(const char* key, const std::vector<std::string>& names) {
    if (names.empty()) add(key, "is empty; name at least one method, such as aabb");
    for (auto name = names.begin(); name != names.end(); ++name) {
      if (find_method(*name) == nullptr)
        add(key, "'" + *name + "' is no method; known are " + known_methods());
      const auto same = [&](const std::string& other) { return find_method(other) == find_method(*name); };
      if (find_method(*name) != nullptr && std::any_of(names.begin(), name, same))
        add(key, "'" + *name + "' is named twice");
    }
  }
  void instruction_set(const char* key, const std::string& name) {
    try {
      static_cast<void>(UsableIsa(parse_isa(name)));
    } catch (const std::invalid_argument& error) {
      add(key, error.what());
    }
  }

  void add(const std::string& key, const std::string& what) { problems_.push_back({key, what}); }

 private:
  static std::string known_methods() {
    std::string names;
    for (const Method& method : pcl_bv::methods())
      names += (names.empty() ? "" : ", ") + std::string(method.name);
    return names;
  }

  std::vector<ConfigProblem>& problems_;
};

void check_together(const PipelineConfig& c, Checker& check) {
  const FilterConfig& filter = c.filter;
  if (filter.range_min > filter.range_max) {
    check.add("filter.range_max",
              digits_of(filter.range_max) + " is below filter.range_min, " + digits_of(filter.range_min));
  }
  if (filter.own_box_min.has_value() != filter.own_box_max.has_value()) {
    check.add(filter.own_box_min ? "filter.own_box_min" : "filter.own_box_max",
              "comes without the other corner: both or none");
  } else if (filter.own_box_min && !(filter.own_box_min->array() <= filter.own_box_max->array()).all()) {
    check.add("filter.own_box_max", "is below filter.own_box_min");
  }
  if (c.cluster.tolerance > 0 && static_cast<float>(c.cluster.tolerance) == 0) {
    check.add("cluster.tolerance", digits_of(c.cluster.tolerance) + " is 0 as a float, which points are");
  }
  if (c.cluster.min_size > c.cluster.max_size) {
    check.add("cluster.max_size", std::to_string(c.cluster.max_size) + " is below cluster.min_size, " +
                                      std::to_string(c.cluster.min_size));
  }
}

std::vector<std::string> lines(const std::vector<ConfigProblem>& problems) {
  std::vector<std::string> texts;
  texts.reserve(problems.size());
  for (const ConfigProblem& problem : problems)
    texts.push_back(problem.key + ": " + problem.what);
  return texts;
}

}  // namespace

std::vector<ConfigProblem> problems_of(const PipelineConfig& config) {
  std::vector<ConfigProblem> problems;
  Checker check(problems);
  visit_pipeline(config, check);
  check_together(config, check);
  return problems;
}

std::vector<ConfigProblem> problems_of(const StreamConfig& config) {
  std::vector<ConfigProblem> problems;
  Checker check(problems);
  visit_stream(config, check);
  check_together(config.pipeline, check);
  return problems;
}

std::vector<std::string> PipelineConfig::validate() const {
  return lines(problems_of(*this));
}

std::vector<std::string> StreamConfig::validate() const {
  return lines(problems_of(*this));
}

}  // namespace pcl_bv
