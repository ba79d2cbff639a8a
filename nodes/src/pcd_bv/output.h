// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where reports go: standard output as they come, or one file at the end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "options.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv {

/// A report in a format, without what stands between reports: the part of the writing that can be done for
/// several at a time. Empty if the format does not show failed inputs.
std::string render(const Report& report, OutputFormat format);

/// Writes rendered reports. Both verbs give false if nobody reads any more and throw IoError.
class ReportWriter {
 public:
  ReportWriter(OutputFormat format, std::optional<std::filesystem::path> file);

  bool add(const std::string& rendered);

  /// To be called after the last report; makes the file.
  bool finish();

 private:
  bool write(const std::string& text);

  OutputFormat format_;
  std::optional<std::filesystem::path> file_;
  std::string pending_;  ///< Content of the file so far.
  bool first_ = true;
};

}  // namespace pcl_bv
