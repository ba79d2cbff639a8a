// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "pcl_bv/kernels/packed_tree.h"

namespace pcl_bv {

/// The nearest of the points that were offered.
class NearestOne {
 public:
  explicit NearestOne(double limit) : best_{-1, limit} {}

  /// What is farther is not wanted any more.
  double limit() const { return best_.squared_distance; }

  void offer(const Neighbor& candidate) {
    if (best_.index < 0 ? candidate.squared_distance <= limit() : candidate < best_) best_ = candidate;
  }

  std::optional<Neighbor> found() const { return best_.index < 0 ? std::nullopt : std::optional(best_); }

 private:
  Neighbor best_;
};

/// The nearest few of them: in order while they are few, else as a heap. Moving up to 32 of 16 bytes costs less than a
/// heap's branches.
class NearestKept {
 public:
  NearestKept(std::size_t most, double limit, std::vector<Neighbor>& kept)
      : most_(most), limit_(limit), kept_(kept) {
    kept_.clear();
    kept_.reserve(std::min<std::size_t>(most, 1024));
  }

  /// What is farther is not wanted any more.
  double limit() const { return limit_; }

  void offer(const Neighbor& candidate) {
    if (kept_.size() == most_ && !(candidate < worst())) return;
    if (in_order()) {
      if (kept_.size() < most_) kept_.push_back(candidate);
      std::size_t place = kept_.size() - 1;
      for (; place > 0 && candidate < kept_[place - 1]; --place)
        kept_[place] = kept_[place - 1];
      kept_[place] = candidate;
    } else {
      if (kept_.size() == most_) {
        std::pop_heap(kept_.begin(), kept_.end());
        kept_.pop_back();
      }
      kept_.push_back(candidate);
      std::push_heap(kept_.begin(), kept_.end());
    }
    if (kept_.size() == most_) limit_ = worst().squared_distance;
  }

  void finish() {
    if (!in_order()) std::sort_heap(kept_.begin(), kept_.end());
  }

 private:
  bool in_order() const { return most_ <= 32; }
  const Neighbor& worst() const { return in_order() ? kept_.back() : kept_.front(); }

  std::size_t most_;
  double limit_;
  std::vector<Neighbor>& kept_;
};

}  // namespace pcl_bv
