// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points in a row, cut into parts for threads: for stages that need more than a merge of what chunks found.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "pcl_bv/parallel/for_each_chunk.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Points 0 to count - 1 cut into parts, each with the members begin and end and what its thread finds. What
/// parts hold stays where it is for the next cut: their memory is used again.
template <typename Part>
class Parts {
 public:
  /// Sets begin and end of each part, of 8192 points at least (or of all): fewer are done before another thread
  /// has come. Two parts a thread, so that one that comes late still finds work. No points: an empty part.
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

  /// work(part) for each, of which none may depend on another. Throws as for_each_chunk() says.
  template <typename Work>
  void for_each(const ParallelPolicy& policy, const Work& work) {
    for_each_chunk(policy, used_, [&](std::size_t p) { work(parts_[p]); });
  }

 private:
  std::vector<Part> parts_;
  std::size_t used_ = 0;
};

}  // namespace pcl_bv
