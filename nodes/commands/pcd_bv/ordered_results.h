// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes results in the order of the inputs, although jobs finish in any order.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "output.h"
#include "process.h"
#include "status.h"

namespace pcl_bv::detail {

/// The result of a finished job.
struct Result {
  std::string text;             ///< The part of the report that is not written yet.
  bool partly_written = false;  ///< Whether the first part has been written.
  std::vector<std::string> messages;
  std::size_t points = 0;
  Status status = Status::done;
};

/// Takes the next part of a long report. If all earlier reports are written, writes the part, empties `text`
/// and returns true. Otherwise returns false and leaves `text` unchanged.
using WriteEarly = std::function<bool(std::string& text)>;

/// Returns the outcome as text. If the report cannot be rendered, most likely for lack of memory, the status
/// is Status::failed or worse. The text is then a report of this error, or empty if the beginning of the
/// report has already been written. Results of other inputs are not affected.
Result result_of(const Outcome& outcome, const RenderOptions& options, const WriteEarly& write = {});

/// As WriteEarly, but also prints the messages of the job.
using WriteJobEarly = std::function<bool(std::vector<std::string>& messages, std::string& text)>;
/// Processes the job. Returns result_of() of the job's outcome, with the messages of the job.
Result do_job(const Job& job, const Options& options, FramePipeline& pipeline,
              const WriteJobEarly& write = {});

/// A progress bar on standard error. It is shown only if requested and if standard error is a terminal.
class Progress {
 public:
  Progress(bool requested, std::size_t files);

  void show(std::size_t files_done, std::size_t points) const;
  void erase() const;

  /// Returns the seconds since construction.
  double seconds() const;

 private:
  const bool visible_;
  const std::size_t files_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Distributes jobs to threads, takes their results in any order and writes them in the order of the jobs.
class OrderedResults {
 public:
  OrderedResults(const Options& options, std::size_t jobs, std::size_t workers);

  /// Returns the number of the next job, or nullopt if there is none or stop() was called. If an earlier job
  /// is not finished and the next job is too far ahead of that job, waits.
  std::optional<std::size_t> next();

  /// Stores the result of a job. Then writes the stored results in order, up to the first job that has no
  /// result yet.
  void add_result(std::size_t job, Result result);

  /// If all earlier jobs are written, prints the messages, writes the text, clears both and returns true.
  /// Otherwise returns false. With early writing, a report of a million clusters is never whole in memory.
  bool write_early(std::size_t job, std::vector<std::string>& messages, std::string& text);

  /// Makes all workers stop after their current job.
  void stop();

  /// Completes the output after the last result. Returns the status of all jobs.
  Status finish();

  /// Stops after the report that is being written, then completes the output file or the JSON array.
  void interrupt();

 private:
  enum class Reports { wanted, no_reader, unwritable };

  void print_messages(const std::vector<std::string>& messages);
  void write_text(std::string&& text, bool goes_on);
  void write(Result& result);
  template <typename Write>
  void attempt_to_write(Write&& what);
  std::string summary() const;

  const Options& options_;
  const std::size_t jobs_, max_ahead_;
  std::mutex mutex_;
  std::condition_variable written_one_;
  std::map<std::size_t, Result> waiting_;  ///< Results that wait for earlier ones.
  std::size_t next_ = 0, written_ = 0;
  bool stopped_ = false;
  bool partly_written_ = false;  ///< Whether the first part of report number `written_` has been written.
  Status status_ = Status::done;
  std::size_t failed_ = 0, points_ = 0;
  ReportWriter writer_;
  Reports reports_ = Reports::wanted;
  Progress progress_;
  const bool erase_before_writing_;
};

}  // namespace pcl_bv::detail
