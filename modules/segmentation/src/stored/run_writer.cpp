// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "run_writer.h"

#include <algorithm>
#include <cstring>

#include "distributed_points.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {

BrickGrid grid_of_runs(const ClusterOptions& options, ScalarType scalar) {
  // Points near other shares are clustered again, cell by cell. Smaller cells make more runs.
  constexpr double halos = 4;
  return {halo_of(options, scalar), halos};
}

// Returns the number of the piece; that of noise is the number of pieces.
std::uint32_t RunWriter::piece_of(std::size_t record) const {
  const std::uint32_t component = components_.component_of(record);
  return component == BrickComponents::kNoise ? components_.piece_count()
                                              : components_.components()[component].piece;
}

// Sorts the records of the brick by piece, and those of a piece by cell. Keeps the order otherwise.
void RunWriter::sort(const std::vector<std::byte>& records, std::size_t piece_count) {
  const ScalarType scalar = components_.scalar();
  const PointView view = view_of_records(records, record_bytes(scalar), scalar);
  const auto is_own = [&](std::size_t i) {
    return (number_of_record(view.address(i), scalar) & kOfOtherBrick) == 0;
  };
  cell_.resize(view.count);
  begin_.assign(piece_count + 2, 0);
  GridCell cell;
  for (std::size_t i = 0; i < view.count; ++i) {
    if (!is_own(i)) continue;
    ++begin_[piece_of(i) + 1];
    if (const auto at = grid_.scaled(load_point(view, i)); !cell.contains(at)) cell = grid_.cell_of(at);
    cell_[i] = cell.key;
  }
  for (std::size_t p = 1; p < begin_.size(); ++p)
    begin_[p] += begin_[p - 1];
  order_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < view.count; ++i)
    if (is_own(i)) order_[next[piece_of(i)]++] = static_cast<std::uint32_t>(i);
}

BrickRuns RunWriter::write(const std::vector<std::byte>& records) {
  const std::size_t pieces = components_.piece_count();
  sort(records, pieces);
  BrickRuns brick;
  brick.pieces.resize(pieces);
  brick.is_complete.assign(pieces, 0);
  for (const BrickComponents::Component& component : components_.components())
    if (component.piece != BrickComponents::kNoPiece) brick.is_complete[component.piece] = !component.shared;
  written_.clear();
  const ScalarType scalar = components_.scalar();
  for (std::size_t p = 0; p <= pieces; ++p) {
    const std::size_t first = begin_[p], end = begin_[p + 1];
    if (p < pieces) {
      const std::byte* const record = records.data() + order_[first] * record_bytes(scalar);
      brick.pieces[p] = {end - first, number_of_record(record, scalar) & kNumberMask};
    }
    add_runs(records, first, end, p < pieces ? static_cast<std::uint32_t>(p) : ShareRun::kNoise, brick.runs);
  }
  brick.records = file_.append(written_.data(), written_.size());
  return brick;
}

void RunWriter::add_runs(const std::vector<std::byte>& records, std::size_t first, std::size_t end,
                         std::uint32_t component, std::vector<ShareRun>& runs) {
  const ScalarType scalar = components_.scalar();
  const std::size_t step = record_bytes(scalar);
  std::vector<std::uint32_t> sorted(order_.begin() + static_cast<std::ptrdiff_t>(first),
                                    order_.begin() + static_cast<std::ptrdiff_t>(end));
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return cell_[a] < cell_[b]; });
  for (std::size_t i = 0; i < sorted.size();) {
    const std::size_t begin = written_.size();
    const std::uint64_t cell = cell_[sorted[i]];
    std::uint64_t points = 0;
    for (; i < sorted.size() && cell_[sorted[i]] == cell; ++i, ++points) {
      const std::byte* const record = records.data() + sorted[i] * step;
      const std::uint64_t number =
          (number_of_record(record, scalar) & kNumberMask) | (components_.is_core(sorted[i]) ? kCore : 0);
      const std::size_t at = written_.size();
      written_.insert(written_.end(), record, record + step);
      std::memcpy(written_.data() + at + point_bytes(scalar), &number, sizeof number);
    }
    runs.push_back({cell, points, component, run_check_sum(&written_[begin], written_.size() - begin)});
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
