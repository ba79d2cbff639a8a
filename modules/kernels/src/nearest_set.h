// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Classes that collect the nearest neighbours while a tree is searched.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "pcl_bv/kernels/packed_tree.h"

namespace pcl_bv::detail {

/// Retains the nearest of the points that were offered.
class NearestOne {
 public:
  explicit NearestOne(double limit) : best_{-1, limit} {}

  /// Squared distance beyond which points need not be offered.
  double limit() const { return best_.squared_distance; }

  void offer(const Neighbor& candidate) {
    if (best_.index < 0 ? candidate.squared_distance <= limit() : candidate < best_) best_ = candidate;
  }

  std::optional<Neighbor> found() const { return best_.index < 0 ? std::nullopt : std::optional(best_); }

 private:
  Neighbor best_;
};

/// Retains the `most` nearest of the points that were offered. If `most` is at most 32, the points are always
/// sorted, because moving them costs less than selecting the nearest later. If `most` is larger, the nearest
/// are selected when 1.5 * most points have been collected, so that a candidate costs only a few nanoseconds.
/// The first selection is made at `most` points already, because only a selection lowers limit().
class NearestSet {
 public:
  NearestSet(std::size_t most, double limit, std::vector<Neighbor>& kept)
      : most_(most), limit_(limit), kept_(kept) {
    kept_.clear();
  }

  /// Squared distance beyond which points need not be offered.
  double limit() const { return limit_; }

  void offer(const Neighbor& candidate) {
    if (most_ <= kFew) {
      insert(candidate);
    } else {
      kept_.push_back(candidate);
      const bool first = kept_.size() == most_ && !full_;
      if (first || kept_.size() >= most_ + most_ / 2) select_nearest();
    }
  }

  void finish() {
    if (most_ <= kFew) return;
    if (kept_.size() > most_) select_nearest();
    std::sort(kept_.begin(), kept_.end());
  }

 private:
  static constexpr std::size_t kFew = 32;

  void insert(const Neighbor& candidate) {
    if (kept_.size() < most_) {
      kept_.push_back(candidate);
    } else if (!(candidate < kept_.back())) {
      return;
    }
    std::size_t position = kept_.size() - 1;
    for (; position > 0 && candidate < kept_[position - 1]; --position)
      kept_[position] = kept_[position - 1];
    kept_[position] = candidate;
    if (kept_.size() == most_) limit_ = kept_.back().squared_distance;
  }

  void select_nearest() {
    const auto last = kept_.begin() + static_cast<std::ptrdiff_t>(most_) - 1;
    std::nth_element(kept_.begin(), last, kept_.end());
    kept_.resize(most_);
    limit_ = kept_.back().squared_distance;
    full_ = true;
  }

  std::size_t most_;
  double limit_;
  std::vector<Neighbor>& kept_;
  bool full_ = false;
};

}  // namespace pcl_bv::detail
