// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A command that is told to end: SIGINT, SIGTERM and SIGHUP.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>
#include <utility>

namespace pcl_bv {

/// While it lives, these signals are blocked, and a thread waits for them. The first one makes it call
/// `finish`, remove temporary files and end the process with status 128 + signal; or it sets `told`, for work
/// that then comes to an end of its own. A second one ends the process at once, in the same way. Signals that
/// the caller has ignored (nohup) stay ignored.
///
/// To be made by the main thread before there are others, which inherit what is blocked.
class Interruption {
 public:
  explicit Interruption(std::function<void()> finish) : finish_(std::move(finish)) { start(); }
  explicit Interruption(std::atomic<bool>& told) : told_(&told) { start(); }

  /// Does not return if a signal has made it finish: the process ends in it.
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

 private:
  void start();
  void watch() const;
  void begin_to_finish(int signal) const;

  std::function<void()> finish_;
  std::atomic<bool>* told_ = nullptr;
  sigset_t before_, awaited_;
  std::thread watcher_;
};

}  // namespace pcl_bv
