// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/yaml.h>

#include <string>

namespace pcl_bv {

/// What yaml-cpp found wrong, in our words: "line 2, column 7: is no YAML: ...". It stops at 500 levels
/// itself, which its stack has room for.
inline std::string yaml_problem(const YAML::Exception& error) {
  const YAML::Mark& at = error.mark;
  const std::string place = at.is_null() ? ""
                                         : "line " + std::to_string(at.line + 1) + ", column " +
                                               std::to_string(at.column + 1) + ": ";
  if (dynamic_cast<const YAML::DeepRecursion*>(&error) != nullptr) return place + "nested more than 500 deep";
  if (dynamic_cast<const YAML::ParserException*>(&error) != nullptr)
    return place + "is no YAML: a bracket, a quote or the indentation is wrong here or before";
  return place + "a key or a value is of another kind than is wanted";
}

}  // namespace pcl_bv
