// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Disjoint sets of cells.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace pcl_bv {

/// Disjoint sets of 0 .. n-1. The root of a set is its smallest member, so the outcome does not depend on the
/// order of the unions.
class UnionFind {
 public:
  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  /// Whether a and b are known to be in one set without a search; false says nothing.
  bool surely_united(std::uint32_t a, std::uint32_t b) const { return parent_[a] == parent_[b]; }

  void unite_roots(std::uint32_t a, std::uint32_t b) {
    if (a < b) {
      parent_[b] = a;
    } else {
      parent_[a] = b;
    }
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace pcl_bv
