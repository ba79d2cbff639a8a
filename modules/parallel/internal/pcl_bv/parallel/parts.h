// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Cuts a sequence of points into parts, each of which is one task. Several parallel loops can run over the
// same parts, which store intermediate results.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// The points 0 ... count - 1, cut into consecutive parts. A Part has members `begin` and `end`, and any
/// members for the results of its task. Parts and the memory they own are reused by the next cut().
template <typename Part>
class PointParts {
 public:
  /// Sets `begin` and `end` of each part. A part has at least 8192 points (or all points), because a smaller
  /// part would be done before another thread has started. There are at most two parts per thread, so that a
  /// thread that starts late still finds work. A policy with one thread gets one part. Zero points give one
  /// empty part.
  void cut(std::size_t count, const ParallelPolicy& policy) {
    const std::size_t threads = thread_count(policy);
    used_ = std::clamp<std::size_t>(count / 8192, 1, threads == 1 ? 1 : 2 * threads);
    if (parts_.size() < used_) parts_.resize(used_);
    for (std::size_t p = 0; p < used_; ++p) {
      parts_[p].begin = p * count / used_;
      parts_[p].end = (p + 1) * count / used_;
    }
  }

  auto begin() { return parts_.begin(); }
  auto end() { return parts_.begin() + static_cast<std::ptrdiff_t>(used_); }
  auto begin() const { return parts_.begin(); }
  auto end() const { return parts_.begin() + static_cast<std::ptrdiff_t>(used_); }
  Part& front() { return parts_.front(); }
  const Part& front() const { return parts_.front(); }

  /// Calls work(part) for each part, in parallel. No call of `work` may depend on another. Throws like
  /// for_each_chunk().
  template <typename Work>
  void for_each(const ParallelPolicy& policy, const Work& work) {
    for_each_chunk(policy, used_, [&](std::size_t p) { work(parts_[p]); });
  }

 private:
  std::vector<Part> parts_;
  std::size_t used_ = 0;
};

}  // namespace detail
}  // namespace pcl_bv
