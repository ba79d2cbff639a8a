// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "run_writer.h"

#include <algorithm>
#include <cstring>

#include "distributed_points.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {

BrickGrid grid_of_runs(const ClusterOptions& options, ScalarType scalar) {
  return {halo_of(options, scalar), kHalosPerRunCell};
}

// Returns the number of the piece; that of noise is the number of pieces.
std::uint32_t RunWriter::piece_of(std::size_t record) const {
  const std::uint32_t component = components_.component_of(record);
  return component == BrickComponents::kNoise ? components_.piece_count()
                                              : components_.components()[component].piece;
}

// Sorts the records of the brick by piece, and keeps their order otherwise.
void RunWriter::sort(const std::vector<std::byte>& records, std::size_t piece_count) {
  const ScalarType scalar = components_.scalar();
  const PointView view = view_of_records(records, record_bytes(scalar), scalar);
  const auto is_own = [&](std::size_t i) {
    return (number_of_record(view.address(i), scalar) & kOfOtherBrick) == 0;
  };
  begin_.assign(piece_count + 2, 0);
  is_near_.assign(piece_count + 1, near_ ? 0 : 1);
  GridCell cell;
  bool near = false;
  for (std::size_t i = 0; i < view.count; ++i) {
    if (!is_own(i)) continue;
    const std::uint32_t piece = piece_of(i);
    ++begin_[piece + 1];
    if (!near_) continue;
    if (const auto at = near_->grid.scaled(load_point(view, i)); !cell.contains(at)) {
      cell = near_->grid.cell_of(at);
      near = near_->keys.contains(BrickGrid::first_quarter(cell.key));
    }
    is_near_[piece] |= static_cast<std::uint8_t>(near);
  }
  for (std::size_t p = 1; p < begin_.size(); ++p)
    begin_[p] += begin_[p - 1];
  order_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < view.count; ++i)
    if (is_own(i)) order_[next[piece_of(i)]++] = static_cast<std::uint32_t>(i);
}

BrickRuns RunWriter::make(const std::vector<std::byte>& records) {
  const std::size_t pieces = components_.piece_count();
  sort(records, pieces);
  const PointView view = view_of_records(records, record_bytes(components_.scalar()), components_.scalar());
  cell_.resize(view.count);
  BrickRuns brick;
  brick.pieces.resize(pieces);
  brick.is_complete.assign(pieces, 0);
  for (const BrickComponents::Component& component : components_.components())
    if (component.piece != BrickComponents::kNoPiece) brick.is_complete[component.piece] = !component.shared;
  buffer_.clear();
  written_.clear();
  const ScalarType scalar = components_.scalar();
  for (std::size_t p = 0; p <= pieces; ++p) {
    const std::size_t first = begin_[p], end = begin_[p + 1];
    if (p < pieces) {
      const std::byte* const record = records.data() + order_[first] * record_bytes(scalar);
      brick.pieces[p] = {end - first, number_of_record(record, scalar) & kNumberMask};
    }
    const std::uint32_t component = p < pieces ? static_cast<std::uint32_t>(p) : ShareRun::kNoise;
    if (first == end) continue;
    const std::uint64_t first_cell = cell_of(view, first);
    if (is_near_[p] == 0 && (p == pieces || brick.is_complete[p] != 0)) {
      brick.runs.push_back({first_cell, end - first, component, ShareRun::kNotWritten});
      continue;
    }
    if (is_near_[p] != 0) {
      find_cells(view, first, end);
    } else {  // one run
      for (std::size_t i = first; i < end; ++i)
        cell_[order_[i]] = first_cell;
    }
    add_runs(records, first, end, component, brick.runs);
  }
  return brick;
}

std::uint64_t RunWriter::cell_of(const PointView& view, std::size_t position) const {
  return grid_.cell_of(grid_.scaled(load_point(view, order_[position]))).key;
}

void RunWriter::find_cells(const PointView& view, std::size_t first, std::size_t end) {
  GridCell cell;
  for (std::size_t i = first; i < end; ++i) {
    const auto at = grid_.scaled(load_point(view, order_[i]));
    if (!cell.contains(at)) cell = grid_.cell_of(at);
    cell_[order_[i]] = cell.key;
  }
}

void RunWriter::add_runs(const std::vector<std::byte>& records, std::size_t first, std::size_t end,
                         std::uint32_t component, std::vector<ShareRun>& runs) {
  const ScalarType scalar = components_.scalar();
  const std::size_t step = record_bytes(scalar);
  std::vector<std::uint32_t> sorted(order_.begin() + static_cast<std::ptrdiff_t>(first),
                                    order_.begin() + static_cast<std::ptrdiff_t>(end));
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return cell_[a] < cell_[b]; });
  if (written_.empty() || written_.back().first_in_brick + written_.back().count != first)
    written_.push_back({first, buffer_.size() / step, 0});
  written_.back().count += end - first;
  for (std::size_t i = 0; i < sorted.size();) {
    const std::size_t begin = buffer_.size();
    const std::uint64_t cell = cell_[sorted[i]];
    std::uint64_t points = 0;
    for (; i < sorted.size() && cell_[sorted[i]] == cell; ++i, ++points) {
      const std::byte* const record = records.data() + sorted[i] * step;
      const std::uint64_t number =
          (number_of_record(record, scalar) & kNumberMask) | (components_.is_core(sorted[i]) ? kCore : 0);
      const std::size_t at = buffer_.size();
      buffer_.insert(buffer_.end(), record, record + step);
      std::memcpy(buffer_.data() + at + point_bytes(scalar), &number, sizeof number);
    }
    runs.push_back(
        {cell, points, component, stored_sum(run_check_sum(&buffer_[begin], buffer_.size() - begin))});
  }
}

std::vector<PointView> RunWriter::complete_pieces(const BrickRuns& brick,
                                                  const std::vector<std::byte>& records,
                                                  const ClusterOptions& options,
                                                  std::vector<std::uint32_t>& pieces) {
  const std::size_t step = record_bytes(components_.scalar()), size = point_bytes(components_.scalar());
  std::vector<PointView> views;
  packed_.resize(order_.size() * size);
  pieces.clear();
  for (std::size_t p = 0; p < brick.pieces.size(); ++p) {
    if (brick.is_complete[p] == 0 || !is_size_allowed(options, brick.pieces[p].points)) continue;
    for (std::size_t i = begin_[p]; i < begin_[p + 1]; ++i)
      std::memcpy(&packed_[i * size], records.data() + order_[i] * step, size);
    views.push_back(packed_points(&packed_[begin_[p] * size], components_.scalar(), brick.pieces[p].points));
    pieces.push_back(static_cast<std::uint32_t>(p));
  }
  return views;
}

}  // namespace pcl_bv::detail
