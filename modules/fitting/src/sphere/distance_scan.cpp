// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "sphere/distance_scan.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "schedule.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kBlocksPerChunk = 32;

// For clouds of at most this number of blocks, the float filter is off: in a small cloud each block probably
// has a point on the sphere, and the float filter cannot reject such a block.
constexpr std::size_t kFewBlocks = 4;

// Margins for the rounding of distances and of sums of distances, at most a few dozen roundings.
constexpr double kRoundUp = 1 + 0x1p-44;
constexpr double kRoundDown = 1 - 0x1p-44;

// Consecutive blocks, at most a chunk.
struct BlockRun {
  std::size_t first, count;
};

std::vector<BlockRun> runs_of(const std::vector<std::uint32_t>& blocks) {
  std::vector<BlockRun> runs;
  for (const std::uint32_t block : blocks) {
    const bool next = !runs.empty() && runs.back().first + runs.back().count == block;
    if (!next || runs.back().count == kBlocksPerChunk) runs.push_back({block, 0});
    ++runs.back().count;
  }
  return runs;
}

double distance_up(const DistanceCenter& a, const DistanceCenter& b) {
  return std::sqrt(squared_distance({a.x, a.y, a.z}, b)) * kRoundUp;
}

void raise(std::atomic<double>& greatest, double found) {
  double known = greatest.load(std::memory_order_relaxed);
  while (found > known && !greatest.compare_exchange_weak(known, found)) {
  }
}

// Replaces `best` by the farthest point of the block in the octant `in_octant`, if that point is farther.
// Only points with a squared distance of at least `squared` are inspected.
void find_in_block(UsableIsa isa, const PointView& block, const DistanceCenter& center, std::size_t in_octant,
                   double squared, FloatFilter filter, FarPoint& best) {
  std::array<std::uint32_t, kBlockPoints> positions;
  const std::size_t count = list_distant(isa, block, center, squared, filter, positions.data());
  for (std::size_t i = 0; i < count; ++i) {
    const Coordinates p = load_point(block, positions[i]);
    if (octant(p, center) != in_octant) continue;
    update_farthest({squared_distance(p, center), block.index(positions[i]), p}, best);
  }
}

}  // namespace

DistanceScan::DistanceScan(const PointView& points, const FitExecution& execution)
    : points_(points),
      parallel_(execution.parallel),
      isa_(execution.isa),
      filter_(FloatFilter::off),
      blocks_(block_count(points.count)),
      far_blocks_(execution.far_blocks) {
  if (points.scalar == ScalarType::float32 && blocks_ > kFewBlocks) filter_ = FloatFilter::reject;
}

bool DistanceScan::serial() const {
  return thread_count(policy(blocks_)) == 1;
}

LoadedPoints DistanceScan::blocks(std::size_t first, std::size_t count) const {
  const std::size_t begin = first * kBlockPoints;
  return {points_, begin, std::min(count * kBlockPoints, points_.count - begin)};
}

ParallelPolicy DistanceScan::policy(std::size_t expected) const {
  return worthwhile({parallel_, isa_}, Work::distance, expected * kBlockPoints);
}

void DistanceScan::visit_runs(const DistanceCenter& center, double limit,
                              const std::function<void(std::size_t first, std::size_t count)>& visit) const {
  std::vector<std::uint32_t> far;
  if (far_blocks_ != nullptr && far_blocks_->find(center, limit, far)) {
    const std::vector<BlockRun> runs = runs_of(far);
    for_each_chunk(policy(far.size()), runs.size(),
                   [&](std::size_t run) { visit(runs[run].first, runs[run].count); });
    return;
  }
  const std::size_t chunks = (blocks_ + kBlocksPerChunk - 1) / kBlocksPerChunk;
  // The last chunks of the pass before, for the supports, may still be in a cache. This reduces the time of a
  // pass over 1 M points by 15 to 30 %, if other programs use the third-level cache, too.
  const bool backward = points_.source == nullptr;
  for_each_chunk(policy(blocks_), chunks, [&](std::size_t chunk) {
    const std::size_t first = (backward ? chunks - 1 - chunk : chunk) * kBlocksPerChunk;
    visit(first, std::min(kBlocksPerChunk, blocks_ - first));
  });
}

void DistanceScan::block_maxima(const DistanceCenter& center, double limit, BlockMaxima& maxima) const {
  maxima.resize(blocks_);
  if (has_device()) std::fill(maxima.begin(), maxima.end(), -1.0);  // of the blocks that it rejects
  visit_far_blocks(center, limit, [&](std::size_t first, std::size_t count) {
    const LoadedPoints points = blocks(first, count);
    OctantScan scan{center, limit, filter_};
    for (std::size_t b = 0; b < count; ++b) {
      scan_octants(isa_, block_of(points.view(), b), scan);
      maxima[first + b] = *std::max_element(scan.max_squared.begin(), scan.max_squared.end());
    }
  });
}

double DistanceScan::greatest(const DistanceCenter& center, double at_least) const {
  std::atomic<double> greatest = at_least;
  visit_far_blocks(center, at_least, [&](std::size_t first, std::size_t count) {
    const LoadedPoints points = blocks(first, count);
    OctantScan scan{center, at_least, filter_};
    for (std::size_t b = 0; b < count; ++b) {
      scan.limit = greatest.load(std::memory_order_relaxed);
      scan_octants(isa_, block_of(points.view(), b), scan);
      raise(greatest, *std::max_element(scan.max_squared.begin(), scan.max_squared.end()));
    }
  });
  return greatest;
}

// The farthest point in each octant among all points that the threads have scanned so far. Points nearer than
// the nearest of these eight points can be skipped. The calls of compete() depend on timing, but the final
// eight points do not.
class DistanceScan::SharedOctants {
 public:
  SharedOctants() {
    for (std::atomic<double>& b : best_)
      b.store(-1, std::memory_order_relaxed);
  }

  double least() const {
    double least = kInfinity;
    for (const std::atomic<double>& b : best_)
      least = std::min(least, b.load(std::memory_order_relaxed));
    return least;
  }

  double operator[](std::size_t octant) const { return best_[octant].load(std::memory_order_relaxed); }

  void raise(const std::array<double, 8>& greatest) {
    for (std::size_t o = 0; o < 8; ++o)
      detail::raise(best_[o], greatest[o]);
  }

  void compete(const FarPoint& candidate, std::size_t octant) {
    const std::lock_guard lock(mutex_);
    update_farthest(candidate, points_[octant]);
  }

  void filtered() { chunks_filtered_.fetch_add(1, std::memory_order_relaxed); }

  /// Valid when all threads have finished.
  const OctantPoints& points() const { return points_; }
  std::size_t chunks_filtered() const { return chunks_filtered_; }

 private:
  std::array<std::atomic<double>, 8> best_;
  std::mutex mutex_;
  OctantPoints points_;
  std::atomic<std::size_t> chunks_filtered_ = 0;
};

void DistanceScan::scan_chunk(std::size_t first, std::size_t count, const DistanceCenter& center,
                              double limit, SharedOctants& best) {
  OctantScan scan{center, limit, filter_};
  std::array<std::array<double, 8>, kBlocksPerChunk> greatest;
  const LoadedPoints points = blocks(first, count);
  for (std::size_t b = 0; b < count; ++b) {
    scan.bounds = bounds_ == nullptr ? nullptr : &bounds_[(first + b) * kBlockBounds];
    scan.limit = std::max(limit, best.least());
    scan_octants(isa_, block_of(points.view(), b), scan);
    greatest[b] = scan.max_squared;
    best.raise(scan.max_squared);
  }
  if (scan.filter == FloatFilter::reject) best.filtered();
  // The farthest points are found while the chunk is in memory. To find them later, a source would have to
  // load the chunk again, and the maxima of all chunks would have to be stored. A billion points have 31 000
  // chunks.
  for (std::size_t o = 0; o < 8; ++o) {
    for (std::size_t b = 0; b < count; ++b) {
      if (greatest[b][o] < 0 || greatest[b][o] < best[o]) continue;
      FarPoint farthest;
      find_in_block(isa_, block_of(points.view(), b), center, o, greatest[b][o], filter_, farthest);
      best.compete(farthest, o);
    }
  }
}

void DistanceScan::scan_all(const DistanceCenter& center, double limit, OctantPoints& found) {
  // The array is not initialised, because the kernel writes every bound.
  if (!scanned_ && has_bounds()) bounds_.reset(new float[blocks_ * kBlockBounds]);
  scanned_ = true;
  scan_center_ = center;
  SharedOctants best;
  visit_far_blocks(center, limit, [&](std::size_t first, std::size_t count) {
    scan_chunk(first, count, center, limit, best);
  });
  found = best.points();
  if (has_device()) return;
  // If the float filter rejected few points in most chunks, most points are near the surface, and bounds do
  // not help either.
  if (2 * best.chunks_filtered() < (blocks_ + kBlocksPerChunk - 1) / kBlocksPerChunk) {
    filter_ = FloatFilter::off;
    bounds_.reset();
  }
}

// Lists the points that can be at least `distance` away from a centre near `center`. Near means that the
// distance from `center` is at most an eighth of the distance between `center` and scan_center_. Returns
// false if these are too many points, or if there are no bounds.
bool DistanceScan::list_shell(const DistanceCenter& center, double distance) {
  if (bounds_ == nullptr) return false;
  const double moved = distance_up(center, scan_center_);
  shell_.clear();
  shell_center_ = center;
  shell_distance_ = distance - moved / 8;
  const double least = (shell_distance_ - moved) * kRoundDown;
  if (!(least > 0)) return false;
  ScanBounds scan_bounds{nullptr, least * least * kRoundDown};
  const double limit = shell_distance_ * shell_distance_ * kRoundDown;
  std::array<std::uint32_t, kBlockPoints> positions;
  for (std::size_t block = 0; block < blocks_; ++block) {
    scan_bounds.bounds = &bounds_[block * kBlockBounds];
    const std::size_t count =
        list_distant_by_bounds(isa_, blocks(block, 1).view(), scan_bounds, center, limit, positions.data());
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = block * kBlockPoints + positions[i];
      const Coordinates p = load_point(points_, at);
      if (is_valid(p)) shell_.push_back({0, points_.index(at), p});
    }
    if (shell_.size() > 64 + points_.count / 16) return false;
  }
  return true;
}

void DistanceScan::scan_shell(const DistanceCenter& center, double limit, OctantPoints& found) const {
  for (const FarPoint& p : shell_) {
    const double squared = squared_distance(p.point, center);
    if (squared >= limit) update_farthest({squared, p.index, p.point}, found[octant(p.point, center)]);
  }
}

bool DistanceScan::farthest(const FarQuery& query, OctantPoints& found) {
  const auto& [center, limit, one_of] = query;
  const double distance = std::sqrt(limit) * kRoundDown;
  found = {};
  if (one_of > 1) {
    scan_sample(query, found);
  } else {
    // A point that is not in shell_ is nearer than shell_distance_ plus the movement of the centre since
    // shell_ was listed. The list remains complete while this sum is below `distance`.
    listed_ = listed_ && shell_center_.scale == center.scale &&
              (shell_distance_ + distance_up(center, shell_center_)) * kRoundUp < distance;
    listed_ = listed_ || (scanned_ && list_shell(center, distance));
    if (listed_) {
      scan_shell(center, limit, found);
    } else if (!scan_and_list(center, limit, found)) {
      scan_all(center, limit, found);
    }
  }
  return std::any_of(found.begin(), found.end(), [](const FarPoint& p) { return p.squared_distance >= 0; });
}

}  // namespace pcl_bv::detail
