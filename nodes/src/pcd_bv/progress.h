// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far the work is, for someone who waits at a terminal.
#pragma once

#include <chrono>
#include <cstddef>

namespace pcl_bv {

/// A bar on standard error, if it was asked for and that is a terminal.
class Progress {
 public:
  /// Shows the bar of no file done.
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

}  // namespace pcl_bv
