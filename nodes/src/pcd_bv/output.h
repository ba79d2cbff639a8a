// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where reports go: standard output as they come, or one file at the end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv {

/// A report in a format, without what stands between reports: the part of the writing that can be done for
/// several at a time. In pieces, of which none is empty; no piece if the format does not show failed inputs.
void render(const Report& report, const ClusterSource& clusters, OutputFormat format, const TextSink& take);

/// Writes rendered reports. All verbs give false if nobody reads any more and throw IoError.
class ReportWriter {
 public:
  ReportWriter(OutputFormat format, std::optional<std::filesystem::path> file);

  /// A piece of a report: the first one, or one that goes on.
  bool add(std::string&& piece, bool goes_on);

  /// To be called after the last report; makes the file.
  bool finish();

 private:
  bool write(std::string&& text);

  OutputFormat format_;
  std::optional<std::filesystem::path> file_;
  std::vector<std::string> pending_;  ///< Content of the file so far.
  bool first_ = true;
};

}  // namespace pcl_bv
