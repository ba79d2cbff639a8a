// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Results that come in any order, written in the order of the inputs.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
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
  std::string text;
  std::vector<std::string> complaints;
  std::size_t points = 0;
  Status status = Status::done;
};

/// The outcome as text. A report that cannot be written (too great for the memory, most likely) becomes one
/// that says so, and the other inputs are still done.
Result result_of(Outcome outcome, OutputFormat format);

/// The same of a job, with what it complains of.
Result do_job(const Job& job, const Options& options, FramePipeline& pipeline);

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

  /// Ends the work of all workers.
  void stop();

  /// After the last result.
  Status finish();

  /// Ends the writing where it is, and makes whole what is written: the file, the array.
  void interrupt();

 private:
  enum class Reports { wanted, unread, unwritable };

  void write(const Result& result);
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
  Status status_ = Status::done;
  std::size_t failed_ = 0, points_ = 0;
  ReportWriter writer_;
  Reports reports_ = Reports::wanted;
  Progress progress_;
  const bool erase_before_writing_;
};

}  // namespace pcl_bv
