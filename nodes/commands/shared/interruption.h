// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Handles SIGINT, SIGTERM and SIGHUP.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>
#include <utility>

namespace pcl_bv {

/// Handles SIGINT, SIGTERM and SIGHUP while this object lives: they are blocked, and a thread waits for them.
///
/// On the first signal, the thread calls `finish`, removes temporary files and ends the process with status
/// 128 + signal. With `stop_flag`, it sets that flag instead, and the work must end by itself. A second
/// signal removes temporary files and ends the process at once, with status 128 + signal. Signals that the
/// caller has ignored (nohup) stay ignored.
///
/// Create it in the main thread before any other thread, since threads inherit the blocked signals.
class Interruption {
 public:
  explicit Interruption(std::function<void()> finish) : finish_(std::move(finish)) { start(); }
  explicit Interruption(std::atomic<bool>& stop_flag) : stop_flag_(&stop_flag) { start(); }

  /// Does not return if a signal has started `finish`: the process ends while it waits.
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

}  // namespace pcl_bv
