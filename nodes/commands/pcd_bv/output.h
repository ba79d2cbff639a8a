// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes reports: each to standard output as soon as it is ready, or all to one file at the end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "pcl_bv/report/box_labels.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv::detail {

/// How a report is rendered.
struct RenderOptions {
  OutputFormat format = OutputFormat::text;
  BoxLabelOptions labels{};
};

/// Returns the options for an input. `frame` is its number, if there are several inputs.
RenderOptions render_options(const Options& options, const std::optional<std::size_t>& frame);

/// Renders one report without the separators between reports, so that several threads can render reports at
/// the same time. `take` gets the text in pieces that are not empty. `take` gets no piece for a failed input
/// if the format does not show failed inputs.
void render(const Report& report, const ClusterSource& clusters, const RenderOptions& options,
            const TextSink& take);

/// Writes rendered reports. Member functions return false if standard output has no reader any more, and
/// throw IoError for any other failure.
class ReportWriter {
 public:
  ReportWriter(OutputFormat format, std::optional<std::filesystem::path> file);

  /// Adds a piece of a report. `goes_on` is false for the first piece of each report.
  bool add(std::string&& piece, bool goes_on);

  /// Completes the output after the last report. If the reports go to a file, creates the file.
  bool finish();

 private:
  bool write(std::string&& text);
  bool begin();

  OutputFormat format_;
  std::optional<std::filesystem::path> file_;
  std::vector<std::string> pending_;  ///< Content of the file so far, in pieces.
  bool begun_ = false;                ///< Whether the beginning of the output has been written.
  bool has_piece_ = false;            ///< Whether a piece that is not empty has been written.
};

}  // namespace pcl_bv::detail
