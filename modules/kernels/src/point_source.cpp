// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Each thread keeps its buffers between parts: a fresh one of 512 KiB would cost 128 page faults, as long as
// reading it.

#include "pcl_bv/kernels/point_source.h"

#include <utility>

namespace pcl_bv {
namespace {

// A source that reads from another one holds two at a time.
constexpr std::size_t kSpares = 2;

thread_local std::vector<std::vector<std::byte>> spares;

}  // namespace

void LoadedPoints::load(const PointSource& source, std::size_t first, std::size_t count) {
  if (!spares.empty()) {
    buffer_ = std::move(spares.back());
    spares.pop_back();
  }
  view_ = source.load(first, count, buffer_);
}

void LoadedPoints::give_back() {
  if (spares.size() < kSpares) spares.push_back(std::move(buffer_));
}

}  // namespace pcl_bv
