// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The bar of --progress.

#include "progress.h"

#include <cstdio>
#include <string>

#include "command/messages.h"

namespace pcl_bv {

Progress::Progress(bool asked, std::size_t files)
    : visible_(asked && errors_go_to_a_terminal()), files_(files) {
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

}  // namespace pcl_bv
