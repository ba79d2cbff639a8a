// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "run_labels.h"

#include <algorithm>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "piece_reader.h"
#include "record.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kRunReadBytes = 1U << 20U;  // of a run at a time

// Runs of a share with about LabelExecution::points_at_a_time points.
struct RunBlock {
  std::uint32_t share, first_run, end_run;
  std::uint64_t offset;  // of the first byte
};

std::vector<RunBlock> blocks_of(const std::vector<const ClusterShare*>& shares, std::size_t block_points) {
  std::vector<RunBlock> blocks;
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    const std::vector<ShareRun>& runs = shares[s]->runs();
    std::uint64_t offset = 0, points = block_points;
    for (std::uint32_t r = 0; r < runs.size(); ++r) {
      if (points >= block_points) {
        blocks.push_back({s, r, r, offset});
        points = 0;
      }
      points += runs[r].points;
      offset += runs[r].points * share_record_bytes(shares[s]->scalar());
      blocks.back().end_run = r + 1;
    }
  }
  return blocks;
}

// Writes labels and check sums in the order of the points. Neighbours in a cell are rarely neighbours in the
// cloud, and each range of numbers is a call of the system.
class SortedLabels {
 public:
  SortedLabels(ShareLabels& written, std::size_t points_at_a_time)
      : written_(written), points_at_a_time_(points_at_a_time) {
    points_.reserve(points_at_a_time);
  }

  void add(std::uint64_t number, std::uint32_t label, std::uint32_t check_sum) {
    points_.push_back({number, label, check_sum});
    if (points_.size() == points_at_a_time_) write();
  }

  void write() {
    std::sort(points_.begin(), points_.end(),
              [](const Point& a, const Point& b) { return a.number < b.number; });
    LabelWriter labels(&written_.labels), sums(&written_.check_sums);
    for (const Point& point : points_) {
      if (point.label != 0) labels.add(point.number, point.label);
      sums.add(point.number, point.check_sum);
    }
    labels.finish();
    sums.finish();
    points_.clear();
  }

 private:
  struct Point {
    std::uint64_t number;
    std::uint32_t label, check_sum;
  };
  ShareLabels& written_;
  std::size_t points_at_a_time_;
  std::vector<Point> points_;
};

}  // namespace

void label_runs(const std::vector<const ClusterShare*>& shares, const LabelOfRun& label_of,
                const LabelExecution& execution, const SpillFile& file, ShareLabels& written) {
  const std::vector<RunBlock> blocks = blocks_of(shares, execution.points_at_a_time);
  for_each_chunk(execution.policy, blocks.size(), [&](std::size_t b) {
    const RunBlock& block = blocks[b];
    const ClusterShare& share = *shares[block.share];
    SortedLabels labels(written, execution.points_at_a_time);
    std::uint64_t offset = block.offset;
    for (std::uint32_t r = block.first_run; r < block.end_run; ++r) {
      const ShareRun& run = share.runs()[r];
      const Piece piece{offset, run.points, {&share, block.share, run.check_sum}};
      offset += run.points * share_record_bytes(share.scalar());
      const std::optional<std::uint32_t> label = label_of(block.share, r);
      if (!label) continue;
      for (PieceReader reader(file, piece, share.scalar(), kRunReadBytes); !reader.done(); reader.next()) {
        if (reader.number() >= written.points)
          throw ShareError(block.share, "has numbers of points that are too large");
        labels.add(reader.number(), *label, point_check_sum(reader.record(), share.scalar()));
      }
    }
    labels.write();
  });
}

}  // namespace pcl_bv::detail
