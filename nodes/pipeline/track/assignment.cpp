// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "assignment.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace pcl_bv::detail {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Reserves four times the needed capacity. If a sequence is replayed, the tracks of its end are still active
// when the tracks of its beginning start again. The replay then has more rows (tracks) than the first pass,
// but must not allocate.
template <typename T>
void refill(std::vector<T>& values, std::size_t count, T value) {
  if (values.capacity() < count) values.reserve(4 * count);
  values.assign(count, value);
}

}  // namespace

void SparseAssignment::solve(std::size_t rows, std::size_t columns, const std::vector<AssignmentPair>& pairs,
                             double unassigned_cost) {
  columns_ = columns;
  unassigned_cost_ = unassigned_cost;
  refill<std::size_t>(first_, rows + 1, 0);
  for (const AssignmentPair& pair : pairs)
    ++first_[pair.row + 1];
  for (std::size_t r = 0; r < rows; ++r)
    first_[r + 1] += first_[r];
  const std::size_t all = columns + rows;
  refill(column_of_, rows, none);
  refill(matched_cost_, rows, 0.0);
  refill(row_of_, all, none);
  refill(from_, all, none);
  refill(potential_, all, 0.0);
  refill(cost_from_, all, 0.0);
  refill(distance_, all, kFar);
  refill<char>(done_, all, 0);
  touched_.reserve(row_of_.capacity());
  settled_.reserve(row_of_.capacity());
  heap_.reserve(2 * row_of_.capacity());
  for (std::size_t r = 0; r < rows; ++r)
    augment(r, pairs);
  for (std::size_t& column : column_of_)
    if (column >= columns) column = none;
}

void SparseAssignment::relax(std::size_t row, std::size_t column, double cost) {
  const double distance = base_distance_ + cost - potential_[column];
  if (done_[column] != 0 || distance >= distance_[column]) return;
  if (distance_[column] == kFar) touched_.push_back(column);
  distance_[column] = distance;
  from_[column] = row;
  cost_from_[column] = cost;
  heap_.emplace_back(distance, column);
  std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
}

// Dijkstra's search from a row to the nearest free column. The potentials keep the reduced costs (see
// relax()) of all later searches non-negative, as Dijkstra's algorithm requires.
void SparseAssignment::augment(std::size_t row, const std::vector<AssignmentPair>& pairs) {
  heap_.clear();
  touched_.clear();
  settled_.clear();
  base_distance_ = 0;
  std::size_t at = row, end = none;
  while (end == none) {
    for (std::size_t p = first_[at]; p < first_[at + 1]; ++p)
      relax(at, pairs[p].column, pairs[p].cost);
    relax(at, columns_ + at, unassigned_cost_);
    HeapEntry next;
    do {  // skip entries of columns that were reached on a shorter path
      std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
      next = heap_.back();
      heap_.pop_back();
    } while (done_[next.second] != 0);
    const std::size_t column = next.second;
    done_[column] = 1;
    settled_.push_back(column);
    if (row_of_[column] == none) {
      end = column;
    } else {
      at = row_of_[column];
      base_distance_ = next.first - (matched_cost_[at] - potential_[column]);
    }
  }
  const double length = distance_[end];
  for (const std::size_t column : settled_)
    potential_[column] += distance_[column] - length;
  for (std::size_t column = end; column != none;) {
    const std::size_t new_row = from_[column], previous_column = column_of_[new_row];
    row_of_[column] = new_row;
    column_of_[new_row] = column;
    matched_cost_[new_row] = cost_from_[column];
    column = new_row == row ? none : previous_column;
  }
  for (const std::size_t column : touched_) {
    distance_[column] = kFar;
    done_[column] = 0;
  }
}

}  // namespace pcl_bv::detail
