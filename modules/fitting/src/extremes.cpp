// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One pass of block extents over the cores, then the exact decision in the blocks that matter.

#include "pcl_bv/fitting/extremes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pcl_bv/kernels/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "schedule.h"
#include "span.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kBlocksPerChunk = 32;  // 32 k points, 512 KiB of PointXYZ: some 10 us of work

// The block extents of a cloud; small clouds, of which there are many in a sweep, need no allocation.
class BlockBuffer {
 public:
  explicit BlockBuffer(std::size_t size) : size_(size), heap_(size > few_.size() ? size : 0) {}
  BlockExtents* data() { return heap_.empty() ? few_.data() : heap_.data(); }
  std::size_t size() const { return size_; }
  const BlockExtents& operator[](std::size_t b) const { return heap_.empty() ? few_[b] : heap_[b]; }

 private:
  std::size_t size_;
  std::array<BlockExtents, 4> few_;
  std::vector<BlockExtents> heap_;
};

// Of a 26-DOP's pass. Only the order of magnitude matters: it decides whether threads are worth starting.
double nanoseconds_per_point(Isa isa, DirectionSet set) {
  const double dop26 = isa == Isa::scalar ? 4.5 : isa == Isa::avx512 ? 0.3 : isa == Isa::avx2 ? 0.6 : 1.2;
  return dop26 * static_cast<double>(direction_count(set)) / 13.0;
}

void find_block_extents(const PointView& points, DirectionSet set, const Execution& execution,
                        BlockBuffer& blocks) {
  const Isa isa = resolve_isa(execution.isa);
  const double serial = nanoseconds_per_point(isa, set) * 1e-9 * static_cast<double>(points.count);
  const std::size_t chunks = (blocks.size() + kBlocksPerChunk - 1) / kBlocksPerChunk;
  for_each_chunk(worthwhile(execution.parallel, serial), chunks, [&](std::size_t chunk) {
    const FloatEnvironment environment;
    const std::size_t first_block = chunk * kBlocksPerChunk;
    const std::size_t first = first_block * kBlockPoints;
    const std::size_t count = std::min(kBlocksPerChunk * kBlockPoints, points.count - first);
    block_extents(isa, points.slice(first, count), set, blocks.data() + first_block);
  });
}

// One end of one direction: the greatest projection on `direction`, which is the set's k-th one or its
// opposite.
struct End {
  std::array<std::int8_t, 3> direction;
  std::size_t k;
  bool low;

  double rounded(const BlockExtents& block) const { return low ? -block.low[k] : block.high[k]; }
};

int terms(const std::array<std::int8_t, 3>& direction) {
  return std::abs(direction[0]) + std::abs(direction[1]) + std::abs(direction[2]);
}

// What a rounded projection must reach to be possibly the exact extreme.
double threshold(const End& end, double rounded_extreme, const Extremes& extremes, ScalarType scalar) {
  if (terms(end.direction) == 1) return rounded_extreme;
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sum += std::max(std::abs(extremes.low[axis]), std::abs(extremes.high[axis]));
  }
  const bool is_float = scalar == ScalarType::float32;
  // Float sums may overflow, and then say nothing.
  if (is_float && sum > std::numeric_limits<float>::max()) return -std::numeric_limits<double>::infinity();
  if (terms(end.direction) == 2) return rounded_extreme;
  // Two sums, each off by 2 u sum; for doubles this very difference may be off by another u sum.
  return rounded_extreme - 5.1 * (is_float ? 0x1p-24 : 0x1p-53) * sum;
}

ExtremePoint find_exact(const PointView& points, const BlockBuffer& blocks, const End& end, double least) {
  ExtremePoint best;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!(end.rounded(blocks[b]) >= least)) continue;
    const std::size_t first = b * kBlockPoints;
    const PointView block = points.slice(first, std::min(kBlockPoints, points.count - first));
    find_extreme_point(block, end.direction, least, best);
  }
  return best;
}

// Both ends of the set's k-th direction; those of the axes must be there already (they are exact as they
// come).
void decide_direction(const PointView& points, const BlockBuffer& blocks, std::size_t k, ExtremeDetail detail,
                      Extremes& out) {
  const std::array<std::int8_t, 3> d = kCubeDirections[cube_direction(out.set, k)];
  const std::array<std::int8_t, 3> opposite = {
      static_cast<std::int8_t>(-d[0]), static_cast<std::int8_t>(-d[1]), static_cast<std::int8_t>(-d[2])};
  double rounded_low = std::numeric_limits<double>::infinity();
  double rounded_high = -rounded_low;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    rounded_low = std::min(rounded_low, blocks[b].low[k]);
    rounded_high = std::max(rounded_high, blocks[b].high[k]);
  }
  if (terms(d) == 1) {
    out.low[k] = rounded_low;
    out.high[k] = rounded_high;
    out.constant[k] = rounded_low == rounded_high;
    if (detail == ExtremeDetail::bounds) return;
  }
  const End low_end{opposite, k, true};
  const End high_end{d, k, false};
  const ScalarType scalar = points.scalar;
  const ExtremePoint low = find_exact(points, blocks, low_end, threshold(low_end, -rounded_low, out, scalar));
  const ExtremePoint high =
      find_exact(points, blocks, high_end, threshold(high_end, rounded_high, out, scalar));
  out.low[k] = -round_up(low.projection) + 0.0;
  out.high[k] = round_up(high.projection);
  out.constant[k] = compare(exact_projection(d, low.point), high.projection) == 0;
  out.low_point[k] = low;
  out.high_point[k] = high;
}

}  // namespace

Extremes find_extremes(const PointView& points, DirectionSet set, ExtremeDetail detail,
                       const Execution& execution) {
  const FloatEnvironment environment;
  BlockBuffer blocks(block_count(points.count));
  find_block_extents(points, set, execution, blocks);
  Extremes extremes;
  extremes.set = set;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    extremes.dropped += blocks[b].dropped;
  extremes.used = points.count - extremes.dropped;
  if (extremes.used == 0) return extremes;
  for (std::size_t k = 0; k < direction_count(set); ++k)
    decide_direction(points, blocks, k, detail, extremes);
  return extremes;
}

EstimationResult result_of(const Extremes& extremes) {
  EstimationResult result;
  result.used = extremes.used;
  result.dropped = extremes.dropped;
  if (extremes.used == 0) return result;
  Span flat;
  for (std::size_t k = 0; k < direction_count(extremes.set); ++k) {
    const auto& d = kCubeDirections[cube_direction(extremes.set, k)];
    if (extremes.constant[k]) flat.add(Eigen::Vector3d(d[0], d[1], d[2]));
  }
  result.rank = 3 - flat.dimensions();
  result.status = result.rank == 3 ? EstimationStatus::ok : EstimationStatus::degenerate;
  return result;
}

}  // namespace pcl_bv
