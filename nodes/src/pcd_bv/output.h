// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where reports go: standard output as they come, or one file at the end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "options.h"
#include "pcl_bv/io/report.h"

namespace pcl_bv {

/// Writes to standard output; false if nobody reads any more. Throws IoError for any other failure.
bool write_standard_output(std::string_view text);

/// Writes reports in one format. Both verbs throw IoError.
class ReportWriter {
 public:
  ReportWriter(OutputFormat format, std::optional<std::filesystem::path> file);

  /// False if nobody reads any more.
  bool add(const Report& report);

  /// To be called after the last report; makes the file.
  void finish();

 private:
  bool write(const std::string& text);

  OutputFormat format_;
  std::optional<std::filesystem::path> file_;
  std::string pending_;  ///< Content of the file so far.
  bool first_ = true;
};

}  // namespace pcl_bv
