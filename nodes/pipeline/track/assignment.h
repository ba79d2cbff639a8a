// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Assignment of rows to columns at minimum total cost.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A row and a column that may be assigned to each other. The cost is finite and at least 0.
struct AssignmentPair {
  std::size_t row = 0, column = 0;
  double cost = 0;
};

/// Solves the sparse assignment problem exactly (Kuhn 1955). Each row gets a column or pays
/// `unassigned_cost`, and the sum of costs is minimal. Uses shortest augmenting paths (Jonker and Volgenant
/// 1987). A path stays within one connected group of pairs, so the time for one group does not depend on the
/// other groups. A reused object keeps its capacity.
class SparseAssignment {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Computes the assignment. `pairs` must be sorted by row and hold each pair once. The result is
  /// deterministic, also for ties. Takes at most O(rows * group * log(group)), where `group` is the number of
  /// pairs in a connected group.
  void solve(std::size_t rows, std::size_t columns, const std::vector<AssignmentPair>& pairs,
             double unassigned_cost);

  /// Returns the column of each row; `none` for an unassigned row.
  const std::vector<std::size_t>& columns() const { return column_of_; }

 private:
  void augment(std::size_t row, const std::vector<AssignmentPair>& pairs);
  void relax(std::size_t row, std::size_t column, double cost);

  using HeapEntry = std::pair<double, std::size_t>;  // distance, column
  // Number of columns. The search also uses column columns_ + r, which means that row r is unassigned.
  std::size_t columns_ = 0;
  double unassigned_cost_ = 0;
  std::vector<std::size_t> first_, column_of_, row_of_, from_, touched_;
  std::vector<double> matched_cost_, potential_, distance_, cost_from_;
  std::vector<char> done_;
  std::vector<HeapEntry> heap_;
  std::vector<std::size_t> settled_;
  double base_distance_ = 0;
};

}  // namespace detail
}  // namespace pcl_bv
