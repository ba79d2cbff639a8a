// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Disjoint sets that any number of threads may join.
#pragma once

#include <atomic>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace pcl_bv::detail {

/// Disjoint sets of the numbers 0 to n - 1. The root of a set is its smallest member, so the result depends
/// neither on the order of the unions nor on the threads.
///
/// A parent is smaller than its child and is only replaced by another ancestor of the child. A thread that
/// reads an old parent finds a longer path to the same root, so relaxed memory order is enough (Anderson and
/// Woll 1991).
class UnionFind {
 public:
  /// Makes n sets with one member each.
  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// Adds a set with one member. This member is n if there were n members.
  void add() { parent_.push_back(static_cast<std::uint32_t>(parent_.size())); }

  /// Sets the parent of a root to another root that is not larger. No other thread may use the two sets
  /// meanwhile.
  void set_root(std::uint32_t i, std::uint32_t root) { parent_[i] = root; }

  std::uint32_t find(std::uint32_t i) {
    for (std::uint32_t up = parent(i); up != i;) {
      const std::uint32_t next = parent(up);
      if (next != up) reference(i).store(next, std::memory_order_relaxed);
      i = up;
      up = next;
    }
    return i;
  }

  /// Joins the sets of two members.
  void unite(std::uint32_t a, std::uint32_t b) {
    for (;;) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a > b) std::swap(a, b);
      std::uint32_t expected = b;
      if (reference(b).compare_exchange_weak(expected, a, std::memory_order_relaxed)) return;
    }
  }

  /// Returns the root of every member. Call it after the last union.
  const std::vector<std::uint32_t>& roots() {
    for (std::uint32_t& parent : parent_)
      parent = parent_[parent];  // the parent is smaller, so its own entry is already its root
    return parent_;
  }

 private:
  std::atomic_ref<std::uint32_t> reference(std::uint32_t i) { return std::atomic_ref(parent_[i]); }
  std::uint32_t parent(std::uint32_t i) { return reference(i).load(std::memory_order_relaxed); }

  std::vector<std::uint32_t> parent_;
};

}  // namespace pcl_bv::detail
