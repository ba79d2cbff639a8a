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

/// Renders one report without the separators between reports, so that several can be rendered at a time.
/// `take` gets the text in pieces that are not empty. It gets none for a failed input if the format does not
/// show those.
void render(const Report& report, const ClusterSource& clusters, OutputFormat format, const TextSink& take);

/// Writes rendered reports. All member functions return false if nobody reads any more and throw IoError.
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
