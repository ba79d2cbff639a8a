// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Handles SIGINT, SIGTERM and SIGHUP.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>
#include <utility>

namespace pcl_bv::detail {

/// Handles SIGINT, SIGTERM and SIGHUP while this object lives. It blocks these signals and waits for them in
/// a thread.
///
/// On the first signal, the thread calls `finish`, removes temporary files and ends the process with status
/// 128 + signal. With `stop_flag`, the thread sets this flag instead, and the work must end by itself. On a
/// second signal, the thread does not wait: it removes temporary files and ends the process with status 128 +
/// signal. Signals that the caller of the program has ignored (nohup) stay ignored.
///
/// Create the object in the main thread before any other thread, because threads inherit the blocked signals.
class Interruption {
 public:
  explicit Interruption(std::function<void()> finish) : finish_(std::move(finish)) { start(); }
  explicit Interruption(std::atomic<bool>& stop_flag) : stop_flag_(&stop_flag) { start(); }

  /// If a signal has started `finish`, the destructor does not return: it waits until the process ends.
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

 private:
  void start();
  void watch() const;
  void start_finishing(int signal) const;

  std::function<void()> finish_;
  std::atomic<bool>* stop_flag_ = nullptr;
  sigset_t previous_mask_, handled_signals_;
  std::thread watcher_;
};

}  // namespace pcl_bv::detail
