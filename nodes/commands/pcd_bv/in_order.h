// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Results that come in any order, written in the order of the inputs.
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

namespace pcl_bv {

/// What is left of a job once it is done.
struct Result {
  std::string text;             ///< What is not written yet.
  bool partly_written = false;  ///< A first part has been written.
  std::vector<std::string> complaints;
  std::size_t points = 0;
  Status status = Status::done;
};

/// Writes a long text before it is whole, and empties it; or leaves it as it is.
using WriteEarly = std::function<bool(std::string& text)>;

/// The outcome as text. A report that cannot be written (too great for the memory, most likely) becomes one
/// that says so, unless its beginning is written; the other inputs are still done.
Result result_of(const Outcome& outcome, OutputFormat format, const WriteEarly& write = {});

/// The same of a job, with what it complains of.
using WriteJobEarly = std::function<bool(std::vector<std::string>& complaints, std::string& text)>;
Result do_job(const Job& job, const Options& options, FramePipeline& pipeline,
              const WriteJobEarly& write = {});

/// A bar on standard error, if it was asked for and that is a terminal.
class Progress {
 public:
  Progress(bool asked, std::size_t files);

  void show(std::size_t files_done, std::size_t points) const;
  void erase() const;

  /// Since construction.
  double seconds() const;

 private:
  const bool visible_;
  const std::size_t files_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Hands out jobs and takes their results, in any order, to write them in the order of the jobs.
class InOrder {
 public:
  InOrder(const Options& options, std::size_t jobs, std::size_t workers);

  /// The next job, or none if there is none or nobody wants more. Waits where too many results would wait for
  /// a slow job before them.
  std::optional<std::size_t> next();

  void take(std::size_t job, Result result);

  /// If it is the job's turn: says the complaints and writes the text, as far as there are some, and clears
  /// both. So a report of a million clusters is never whole in memory.
  bool write_early(std::size_t job, std::vector<std::string>& complaints, std::string& text);

  /// Ends the work of all workers.
  void stop();

  /// After the last result.
  Status finish();

  /// Ends the writing after the report that is begun, and makes whole what is written: the file, the array.
  void interrupt();

 private:
  enum class Reports { wanted, unread, unwritable };

  void say_all(const std::vector<std::string>& complaints);
  void write_text(std::string&& text, bool goes_on);
  void write(Result& result);
  template <typename Write>
  void attempt_to_write(Write&& what);
  std::string summary() const;

  const Options& options_;
  const std::size_t jobs_, ahead_;
  std::mutex mutex_;
  std::condition_variable written_one_;
  std::map<std::size_t, Result> waiting_;  ///< For the results before them.
  std::size_t next_ = 0, written_ = 0;
  bool stopped_ = false;
  bool partly_written_ = false;  ///< A first part of report `written_` has been written.
  Status status_ = Status::done;
  std::size_t failed_ = 0, points_ = 0;
  ReportWriter writer_;
  Reports reports_ = Reports::wanted;
  Progress progress_;
  const bool erase_before_writing_;
};

}  // namespace pcl_bv
