// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Error messages for exceptions of yaml-cpp.
#pragma once

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/yaml.h>

#include <string>

namespace pcl_bv::detail {

/// Returns the message for an error of yaml-cpp, such as "line 2: invalid YAML: ... (column 7)". yaml-cpp
/// itself refuses nesting deeper than 500 levels, before its recursion can overflow the stack.
inline std::string yaml_error_message(const YAML::Exception& error) {
  const YAML::Mark& at = error.mark;
  std::string what = "a key or value has the wrong type";
  if (dynamic_cast<const YAML::DeepRecursion*>(&error) != nullptr) {
    what = "nested more than 500 deep";
  } else if (dynamic_cast<const YAML::ParserException*>(&error) != nullptr) {
    what = "invalid YAML: check brackets, quotes and indentation here and before";
  }
  if (at.is_null()) return what;
  return "line " + std::to_string(at.line + 1) + ": " + what + " (column " + std::to_string(at.column + 1) +
         ")";
}

}  // namespace pcl_bv::detail
