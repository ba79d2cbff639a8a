// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "pcl_bv/kernels/packed_tree.h"

namespace pcl_bv {

/// The nearest of the points that were offered, in order while they are few, else as a heap: moving up to 32 of 16
/// bytes costs less than a heap's branches.
class NearestKept {
 public:
  NearestKept(std::size_t most, double limit, std::vector<Neighbor>& kept)
      : most_(most), limit_(limit), kept_(kept) {
    kept_.clear();
  }

  std::size_t most() const { return most_; }

  /// What is farther is not wanted any more.
  double limit() const { return limit_; }

  void offer(const Neighbor& candidate) {
    if (kept_.size() == most_) {
      if (!(candidate < kept_[in_order() ? most_ - 1 : 0])) return;
      if (!in_order()) std::pop_heap(kept_.begin(), kept_.end());
      kept_.pop_back();
    }
    if (in_order()) {
      kept_.insert(std::upper_bound(kept_.begin(), kept_.end(), candidate), candidate);
    } else {
      kept_.push_back(candidate);
      std::push_heap(kept_.begin(), kept_.end());
    }
    if (kept_.size() == most_) limit_ = kept_[in_order() ? most_ - 1 : 0].squared_distance;
  }

  void finish() {
    if (!in_order()) std::sort_heap(kept_.begin(), kept_.end());
  }

 private:
  bool in_order() const { return most_ <= 32; }

  std::size_t most_;
  double limit_;
  std::vector<Neighbor>& kept_;
};

}  // namespace pcl_bv
