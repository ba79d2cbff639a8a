// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A command that is told to end: SIGINT, SIGTERM and SIGHUP.
#pragma once

#include <csignal>
#include <functional>
#include <thread>

namespace pcl_bv {

/// While it lives, these signals are blocked, and a thread waits for them: the first one makes it call
/// `finish`, remove temporary files and end the process with status 128 + signal. A second one does so at
/// once, without what `finish` has not done yet. Signals that the caller has ignored (nohup) stay ignored.
///
/// To be made by the main thread before there are others, which inherit what is blocked.
class Interruption {
 public:
  explicit Interruption(std::function<void()> finish);

  /// Does not return if a signal has come: the process ends in it.
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

 private:
  void watch() const;

  std::function<void()> finish_;
  sigset_t before_, awaited_;
  std::thread watcher_;
};

}  // namespace pcl_bv
