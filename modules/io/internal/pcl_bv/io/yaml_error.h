// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Error messages for exceptions of yaml-cpp, and a limit on its memory.
#pragma once

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <sstream>
#include <string>

#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::detail {

/// Counts the values of a document: scalars, lists, maps and aliases.
class YamlCounter : public YAML::EventHandler {
 public:
  std::size_t values = 0;

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override { count(); }
  void OnAlias(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override { count(); }
  void OnScalar(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                const std::string& /*value*/) override {
    count();
  }
  void OnSequenceStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                       YAML::EmitterStyle::value /*style*/) override {
    count();
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {
    count();
  }
  void OnMapEnd() override {}

 protected:
  static constexpr std::size_t kMaxValues = 500'000;

 private:
  void count() {
    if (++values > kMaxValues) throw IoError("has more than " + std::to_string(kMaxValues) + " values");
  }
};

/// Throws IoError if the first document has more than 500 000 values: yaml-cpp takes about 500 bytes for
/// each, which may have 2 bytes in the file. Throws YAML::Exception for invalid YAML.
inline void require_few_yaml_nodes(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  YamlCounter counter;
  parser.HandleNextDocument(counter);
}

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
