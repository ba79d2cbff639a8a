// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tile_progress.h"

#include <sys/resource.h>

#include <chrono>
#include <cstdio>

#include "commands/shared/messages.h"

namespace pcl_bv::detail {
namespace {

// The most memory that the process has had.
double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024e-6;
}

}  // namespace

TileProgress::TileProgress(Tiles& tiles, const Options& options) : tiles_(tiles) {
  if (!options.progress || !errors_go_to_a_terminal()) return;
  tiles.on_loaded = [begin = std::chrono::steady_clock::now(), &tiles](std::size_t points) {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    char text[120];
    std::snprintf(text, sizeof text, "%zu files, %.1f M points read in all passes, %.1f s, %.0f MB",
                  tiles.included_count(), static_cast<double>(points) / 1e6, time.count(), peak_megabytes());
    show_status_line(text);
  };
}

TileProgress::~TileProgress() {
  if (!tiles_.on_loaded) return;
  tiles_.on_loaded = nullptr;
  erase_status_line();
}

}  // namespace pcl_bv::detail
