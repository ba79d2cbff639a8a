// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ordered_results.h"

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <new>
#include <utility>

#include "commands/shared/messages.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::detail {

Result result_of(const Outcome& outcome, const RenderOptions& options, const WriteEarly& write) {
  constexpr std::size_t many = std::size_t{4} << 20;  // bytes; shorter texts may wait in memory
  Result result;
  result.status = outcome.status;
  result.points = outcome.report.error ? 0 : outcome.report.points;
  Report failed;
  try {
    render(outcome.report, outcome.clusters(), options, [&](std::string& piece) {
      if (result.text.empty()) {
        result.text.swap(piece);
      } else {
        result.text += piece;
      }
      if (write && result.text.size() > many) result.partly_written |= write(result.text);
    });
    return result;
  } catch (const std::bad_alloc&) {
    failed.error = "not enough memory for its report";
  } catch (const std::exception& error) {
    failed.error = reason_of(error);
  }
  failed.file = outcome.report.file;
  report_problem(failed.file + ": " + *failed.error);
  result.text.clear();
  result.points = 0;
  result.status = worse(outcome.status, Status::failed);
  if (!result.partly_written) render(failed, {}, options, [&](std::string& piece) { result.text += piece; });
  return result;
}

Result do_job(const Job& job, const Options& options, FramePipeline& pipeline, const WriteJobEarly& write) {
  DeferredMessages deferred;
  const WriteEarly early = [&](std::string& text) { return write(deferred.messages, text); };
  Result result = result_of(process(job, options, pipeline), render_options(options, job.frame),
                            write ? early : WriteEarly());
  result.messages = std::move(deferred.messages);
  return result;
}

Progress::Progress(bool requested, std::size_t files)
    : visible_(requested && errors_go_to_a_terminal()), files_(files) {
  show(0, 0);
}

void Progress::show(std::size_t files_done, std::size_t points) const {
  if (!visible_) return;
  constexpr std::size_t width = 30;
  std::string bar(files_done * width / files_, '#');
  bar.resize(width, '-');
  char text[160];
  std::snprintf(text, sizeof text, "[%s] %zu/%zu files, %.1f M points, %.1f s", bar.c_str(), files_done,
                files_, static_cast<double>(points) / 1e6, seconds());
  show_status_line(text);
}

void Progress::erase() const {
  if (visible_) erase_status_line();
}

double Progress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

OrderedResults::OrderedResults(const Options& options, std::size_t jobs, std::size_t workers)
    : options_(options),
      jobs_(jobs),
      max_ahead_(8 * workers),
      writer_(options.format, options.output),
      progress_(options.progress, jobs),
      erase_before_writing_(!options.output && isatty(STDOUT_FILENO) != 0) {}

std::optional<std::size_t> OrderedResults::next() {
  std::unique_lock lock(mutex_);
  written_one_.wait(lock, [&] { return stopped_ || next_ >= jobs_ || next_ < written_ + max_ahead_; });
  if (stopped_ || next_ >= jobs_) return std::nullopt;
  return next_++;
}

void OrderedResults::add_result(std::size_t job, Result result) {
  const std::lock_guard lock(mutex_);
  waiting_.emplace(job, std::move(result));
  for (auto first = waiting_.begin();
       first != waiting_.end() && first->first == written_ && (!stopped_ || partly_written_);
       first = waiting_.erase(first), ++written_) {
    write(first->second);
  }
  written_one_.notify_all();
}

void OrderedResults::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  written_one_.notify_all();
}

Status OrderedResults::finish() {
  const std::lock_guard lock(mutex_);
  if (reports_ == Reports::wanted) attempt_to_write([&] { return writer_.finish(); });
  progress_.erase();
  if (jobs_ > 1 && written_ == jobs_ && reports_ != Reports::no_reader) print_message(summary());
  reports_ = Reports::no_reader;
  return status_;
}

void OrderedResults::interrupt() {
  std::unique_lock lock(mutex_);
  stopped_ = true;
  written_one_.wait(lock, [&] { return !partly_written_; });
  progress_.erase();
  if (reports_ == Reports::wanted && written_ > 0) attempt_to_write([&] { return writer_.finish(); });
  reports_ = Reports::no_reader;
  print_message("interrupted: " + std::to_string(written_) + " of " + std::to_string(jobs_) + " files done");
}

bool OrderedResults::write_early(std::size_t job, std::vector<std::string>& messages, std::string& text) {
  const std::lock_guard lock(mutex_);
  if (job != written_ || (stopped_ && !partly_written_)) return false;
  print_messages(std::exchange(messages, {}));
  write_text(std::exchange(text, {}), std::exchange(partly_written_, true));
  return true;
}

void OrderedResults::print_messages(const std::vector<std::string>& messages) {
  for (const std::string& message : messages)
    print_message(message);
}

void OrderedResults::write_text(std::string&& text, bool goes_on) {
  if (erase_before_writing_) progress_.erase();
  if (reports_ != Reports::wanted || (goes_on && text.empty())) return;
  attempt_to_write([&] { return writer_.add(std::move(text), goes_on); });
}

void OrderedResults::write(Result& result) {
  print_messages(result.messages);
  write_text(std::move(result.text), std::exchange(partly_written_, false));
  status_ = worse(status_, result.status);
  failed_ += result.status == Status::failed ? 1 : 0;
  points_ += result.points;
  progress_.show(written_ + 1, points_);
  // If nobody can read reports, the work continues only to write files or check volumes.
  if (reports_ != Reports::wanted && !writes_files(options_) && !options_.check) stopped_ = true;
}

template <typename Write>
void OrderedResults::attempt_to_write(Write&& what) {
  try {
    if (!what()) reports_ = Reports::no_reader;
  } catch (const IoError& error) {
    print_message((options_.output ? options_.output->string() : "standard output") + ": " + error.what());
    status_ = worse(status_, Status::failed);
    reports_ = Reports::unwritable;
  }
}

std::string OrderedResults::summary() const {
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.2f", progress_.seconds());
  return std::to_string(jobs_) + " files: " + std::to_string(jobs_ - failed_) + " done, " +
         std::to_string(failed_) + " failed, " + std::to_string(points_) + " points, " + seconds + " s";
}

}  // namespace pcl_bv::detail
