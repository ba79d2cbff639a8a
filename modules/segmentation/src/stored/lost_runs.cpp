// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "lost_runs.h"

#include "brick_grid.h"
#include "piece_reader.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kReadAtATime = 1U << 20U;

bool is_readable(const Piece& run, ScalarType scalar, const SpillFile& file) {
  try {
    for (PieceReader reader(file, run, scalar, kReadAtATime); !reader.done();)
      reader.next();
    return true;
  } catch (const ShareError& error) {
    if (!error.wrong_sum()) throw;
    return false;
  }
}

}  // namespace

std::uint64_t LostRuns::find(const std::vector<const ClusterShare*>& shares, std::size_t share,
                             const SpillFile& file) {
  if (!lost_[share].empty()) return 0;
  const ClusterShare& from = *shares[share];
  lost_[share].resize(from.runs().size());
  std::uint64_t offset = 0, points = 0;
  for (std::size_t r = 0; r < from.runs().size(); ++r) {
    const ShareRun& run = from.runs()[r];
    if (!is_readable({offset, run.points, {&from, share, run.check_sum}}, from.scalar(), file)) {
      lost_[share][r] = 1;
      points += run.points;
      for (int i = 0; i < 27; ++i)
        cells_.insert(BrickGrid::neighbour(run.cell, i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
    }
    offset += run.points * share_record_bytes(from.scalar());
  }
  return points;
}

}  // namespace pcl_bv::detail
