// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Choices by name.

#include <array>
#include <stdexcept>
#include <utility>

#include "config_fields.h"

namespace pcl_bv {
namespace {

template <typename Choice, std::size_t n>
using Names = std::array<std::pair<std::string_view, Choice>, n>;

constexpr Names<GroundMethod, 3> kGroundMethods{
    {{"none", GroundMethod::none}, {"plane", GroundMethod::plane}, {"zones", GroundMethod::zones}}};
constexpr Names<QueuePolicy, 4> kPolicies{{{"auto", QueuePolicy::automatic},
                                           {"drop_oldest", QueuePolicy::drop_oldest},
                                           {"drop_newest", QueuePolicy::drop_newest},
                                           {"block", QueuePolicy::block}}};
constexpr Names<UpAxis, 6> kAxes{{{"x", UpAxis::x},
                                  {"y", UpAxis::y},
                                  {"z", UpAxis::z},
                                  {"-x", UpAxis::minus_x},
                                  {"-y", UpAxis::minus_y},
                                  {"-z", UpAxis::minus_z}}};

template <typename Choice, std::size_t n>
Choice parse(const Names<Choice, n>& names, std::string_view text) {
  std::string known;
  for (const auto& [name, choice] : names) {
    if (name == text) return choice;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw std::invalid_argument("'" + std::string(text) + "' is not one of " + known);
}

template <typename Choice, std::size_t n>
std::string_view find_name(const Names<Choice, n>& names, Choice choice) {
  for (const auto& [name, value] : names) {
    if (value == choice) return name;
  }
  return {};
}

}  // namespace

GroundMethod parse_ground_method(std::string_view text) {
  return parse(kGroundMethods, text);
}
std::string_view name_of(GroundMethod method) {
  return find_name(kGroundMethods, method);
}
QueuePolicy parse_queue_policy(std::string_view text) {
  return parse(kPolicies, text);
}
std::string_view name_of(QueuePolicy policy) {
  return find_name(kPolicies, policy);
}
QueuePolicy resolved(QueuePolicy policy, bool paced) {
  if (policy != QueuePolicy::automatic) return policy;
  return paced ? QueuePolicy::drop_oldest : QueuePolicy::block;
}
std::string_view name_of(UpAxis axis) {
  return find_name(kAxes, axis);
}

}  // namespace pcl_bv
