// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// All inputs over the cores, all results in order.

#include "process.h"

#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "command/interruption.h"
#include "command/messages.h"
#include "output.h"
#include "pcl_bv/io/io_error.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv {
namespace {

/// What is left of a job once it is done.
struct Result {
  std::string text;
  std::vector<std::string> complaints;
  std::size_t points = 0;
  Status status = Status::done;
};

/// The report as text. One that cannot be written (too great for the memory, most likely) becomes one that
/// says so, and the other inputs are still done.
std::string render_or_say_why(Outcome& outcome, OutputFormat format) {
  try {
    return render(outcome.report, format);
  } catch (const std::bad_alloc&) {
    outcome.report.error = "not enough memory for its report";
  } catch (const std::exception& error) {
    outcome.report.error = error.what();
  }
  complain(outcome.report.file + ": " + *outcome.report.error);
  outcome.status = worse(outcome.status, Status::failed);
  outcome.report.clusters.clear();
  return render(outcome.report, format);
}

Result do_job(const Job& job, const Options& options, FramePipeline& pipeline) {
  HeldComplaints complaints;
  Outcome outcome = process(job, options, pipeline);
  std::string text = render_or_say_why(outcome, options.format);
  const std::size_t points = outcome.report.error ? 0 : outcome.report.points;
  return {std::move(text), std::move(complaints.kept), points, outcome.status};
}

/// A bar on standard error, if it was asked for and that is a terminal.
class Progress {
 public:
  Progress(bool asked, std::size_t files) : visible_(asked && errors_go_to_a_terminal()), files_(files) {
    show(0, 0);
  }

  void show(std::size_t files_done, std::size_t points) const {
    if (!visible_) return;
    constexpr std::size_t width = 30;
    std::string bar(files_done * width / files_, '#');
    bar.resize(width, '-');
    char text[160];
    std::snprintf(text, sizeof text, "[%s] %zu/%zu files, %.1f M points, %.1f s", bar.c_str(), files_done,
                  files_, static_cast<double>(points) / 1e6, seconds());
    show_status_line(text);
  }

  void erase() const {
    if (visible_) erase_status_line();
  }

  /// Since construction.
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  const bool visible_;
  const std::size_t files_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Hands out jobs and takes their results, in any order, to write them in the order of the jobs.
class InOrder {
 public:
  InOrder(const Options& options, std::size_t jobs, std::size_t workers)
      : options_(options),
        jobs_(jobs),
        ahead_(8 * workers),
        writer_(options.format, options.output),
        progress_(options.progress, jobs),
        erase_before_writing_(!options.output && isatty(STDOUT_FILENO) != 0) {}

  /// The next job, or none if there is none or nobody wants more. Waits where too many results would wait for
  /// a slow job before them.
  std::optional<std::size_t> next() {
    std::unique_lock lock(mutex_);
    written_one_.wait(lock, [&] { return stopped_ || next_ >= jobs_ || next_ < written_ + ahead_; });
    if (stopped_ || next_ >= jobs_) return std::nullopt;
    return next_++;
  }

  void take(std::size_t job, Result result) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(job, std::move(result));
    for (auto first = waiting_.begin(); first != waiting_.end() && first->first == written_ && !stopped_;
         first = waiting_.erase(first), ++written_) {
      write(first->second);
    }
    written_one_.notify_all();
  }

  /// Ends the work of all workers.
  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    written_one_.notify_all();
  }

  /// After the last result.
  Status finish() {
    const std::lock_guard lock(mutex_);
    if (reports_ == Reports::wanted) attempt_to_write([&] { return writer_.finish(); });
    progress_.erase();
    if (jobs_ > 1 && written_ == jobs_ && reports_ != Reports::unread) say(summary());
    reports_ = Reports::unread;
    return status_;
  }

  /// Ends the writing where it is, and makes whole what is written: the file, the array.
  void interrupt() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    progress_.erase();
    if (reports_ == Reports::wanted && written_ > 0) attempt_to_write([&] { return writer_.finish(); });
    reports_ = Reports::unread;
    say("interrupted: " + std::to_string(written_) + " of " + std::to_string(jobs_) + " files done");
  }

 private:
  enum class Reports { wanted, unread, unwritable };

  void write(const Result& result) {
    for (const std::string& complaint : result.complaints)
      say(complaint);
    if (erase_before_writing_) progress_.erase();
    if (reports_ == Reports::wanted) attempt_to_write([&] { return writer_.add(result.text); });
    status_ = worse(status_, result.status);
    failed_ += result.status == Status::failed ? 1 : 0;
    points_ += result.points;
    progress_.show(written_ + 1, points_);
    // What else was asked for is done all the same.
    if (reports_ != Reports::wanted && !writes_files(options_) && !options_.check) stopped_ = true;
  }

  template <typename Write>
  void attempt_to_write(Write&& what) {
    try {
      if (!what()) reports_ = Reports::unread;
    } catch (const IoError& error) {
      say((options_.output ? options_.output->string() : "standard output") + ": " + error.what());
      status_ = worse(status_, Status::failed);
      reports_ = Reports::unwritable;
    }
  }

  std::string summary() const {
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%.2f", progress_.seconds());
    return std::to_string(jobs_) + " files: " + std::to_string(jobs_ - failed_) + " done, " +
           std::to_string(failed_) + " failed, " + std::to_string(points_) + " points, " + seconds + " s";
  }

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

// What one file needs, the next one needs again: given back to the system each time, 24 sweeps of a 64-beam
// sensor cost 38 000 page faults instead of 3 200 and 0.51 s of processor time instead of 0.45.
void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

void work(const std::vector<Job>& jobs, const Options& options, InOrder& order) {
  try {
    FramePipeline pipeline(options.pipeline);
    while (const auto job = order.next())
      order.take(*job, do_job(jobs[*job], options, pipeline));
  } catch (...) {
    order.stop();
    throw;
  }
}

}  // namespace

Status process_all(const std::vector<Job>& jobs, const Options& options) {
  const ParallelPolicy policy = options.pipeline.policy();
  const unsigned threads = thread_count(policy);
  const unsigned workers = jobs.size() >= threads ? threads : 1;
  Options each = options;
  if (workers > 1) each.pipeline.threads = 1;
  if (jobs.size() > 1) keep_freed_memory();
  InOrder order(options, jobs.size(), workers);
  const Interruption interruption([&] { order.interrupt(); });
  for_each_chunk(policy, workers, [&](std::size_t) { work(jobs, each, order); });
  return order.finish();
}

}  // namespace pcl_bv
