// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Who belongs to whom at the least cost.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A row and a column that may be joined, at a finite cost of 0 or more.
struct AssignmentPair {
  std::size_t row = 0, column = 0;
  double cost = 0;
};

/// The exact least sum of costs where each row gets a column or pays `alone` (Kuhn 1955), by shortest
/// augmenting paths (Jonker and Volgenant 1987) over the pairs there are: a path goes no farther than its
/// group of pairs, so groups that do not touch cost nothing to each other. Reuse keeps the capacity.
class SparseAssignment {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// `pairs` in ascending order of rows, each pair once. Same input, same result, ties included.
  /// O(rows * group * log(group)) at worst.
  void solve(std::size_t rows, std::size_t columns, const std::vector<AssignmentPair>& pairs, double alone);

  /// Of each row, its column or none.
  const std::vector<std::size_t>& columns() const { return column_of_; }

 private:
  void augment(std::size_t row, const std::vector<AssignmentPair>& pairs);
  void reach(std::size_t row, std::size_t column, double distance);

  using Reached = std::pair<double, std::size_t>;  // distance, column
  std::size_t columns_ = 0;                        // real ones; the others are each row's own
  double alone_ = 0;
  std::vector<std::size_t> first_, column_of_, row_of_, from_, touched_;
  std::vector<double> matched_cost_, price_, distance_, cost_from_;
  std::vector<char> done_;
  std::vector<Reached> heap_;
  std::vector<std::size_t> settled_;
  double base_ = 0;
};

}  // namespace pcl_bv
