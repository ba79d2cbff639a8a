// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "spatial_order.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr std::size_t kMaxParts = 4;
constexpr std::size_t kMaxBins = 1024;

// The longest side of the box around a run.
struct Side {
  std::size_t axis;
  double low, length;
};

template <typename T>
Side longest_side(const ItemRun<T>& run) {
  Extremes<T> extremes;
  for (std::size_t i = 0; i < run.count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      extremes.add(axis, run.items[i].position[axis]);
  }
  const auto [low, high] = extremes.bounds();
  Side longest{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (high[axis] - low[axis] > longest.length) longest = {axis, low[axis], high[axis] - low[axis]};
  }
  return longest;
}

// The positions at which the parts of a run begin, and at which the last part ends.
struct Cuts {
  std::array<std::size_t, kMaxParts + 1> at{};
  std::size_t parts;

  explicit Cuts(std::size_t count) {
    std::size_t unit = kTreeWidth;
    while (unit * kTreeWidth < count)
      unit *= kTreeWidth;
    const std::size_t units = (count + unit - 1) / unit;
    parts = std::min(units, kMaxParts);
    for (std::size_t p = 0; p < parts; ++p)
      at[p] = units * p / parts * unit;
    at[parts] = count;
  }
};

// Writes the bin of each item and counts the items of each bin. Bins are ascending along the side.
template <typename T>
void fill_bins(const ItemRun<T>& run, const Side& side, std::size_t bins, std::uint32_t* counts) {
  std::fill_n(counts, bins, 0U);
  // The factor is slightly too small, so that rounding cannot move an item beyond the last bin.
  const double per_length = (static_cast<double>(bins) - 0x1p-20) / side.length;
  for (std::size_t i = 0; i < run.count; ++i) {
    const double along = static_cast<double>(run.items[i].position[side.axis]) - side.low;
    const auto bin = static_cast<std::uint16_t>(static_cast<std::int32_t>(along * per_length));
    run.bins[i] = bin;
    ++counts[bin];
  }
}

// Groups the bins into buckets. Each bin that contains a cut position is a bucket by itself. All bins between
// two such bins form one bucket. `begin` holds the first position of each bucket.
struct Buckets {
  std::array<std::uint8_t, kMaxBins> of_bin;
  std::array<std::size_t, 2 * kMaxParts> begin{};
  std::array<std::size_t, kMaxParts + 1> of_cut{};  // for each cut, the bucket of the bin that it divides

  Buckets(const Cuts& cuts, std::size_t bins, const std::uint32_t* counts) {
    std::size_t position = 0, bucket = 0, cut = 1;
    for (std::size_t bin = 0; bin < bins; ++bin) {
      const std::size_t end = position + counts[bin];
      const bool through = cut < cuts.parts && cuts.at[cut] < end;
      if (through && position > begin[bucket]) begin[++bucket] = position;
      of_bin[bin] = static_cast<std::uint8_t>(bucket);
      if (through) {
        for (; cut < cuts.parts && cuts.at[cut] < end; ++cut)
          of_cut[cut] = bucket;
        begin[++bucket] = end;
      }
      position = end;
    }
  }
};

template <typename T>
void move_items(const ItemRun<T>& run, const Buckets& buckets) {
  std::array<std::size_t, 2 * kMaxParts> position = buckets.begin;
  for (std::size_t i = 0; i < run.count; ++i)
    run.other[position[buckets.of_bin[run.bins[i]]]++] = run.items[i];
}

// Moves the items to `other`, so that the items of each part are at the positions of this part.
template <typename T>
void cut(const ItemRun<T>& run, const Side& side, const Cuts& cuts) {
  std::array<std::uint32_t, kMaxBins> counts;
  const std::size_t bins = std::min(kMaxBins, run.count);
  fill_bins(run, side, bins, counts.data());
  const Buckets buckets(cuts, bins, counts.data());
  move_items(run, buckets);
  const auto precedes = [axis = side.axis](const PositionedItem<T>& a, const PositionedItem<T>& b) {
    return a.position[axis] < b.position[axis] || (a.position[axis] == b.position[axis] && a.index < b.index);
  };
  for (std::size_t c = 1; c < cuts.parts; ++c) {
    const std::size_t bucket = buckets.of_cut[c];
    const std::size_t begin = std::max(buckets.begin[bucket], cuts.at[c - 1]);
    std::nth_element(run.other + begin, run.other + cuts.at[c], run.other + buckets.begin[bucket + 1],
                     precedes);
  }
}

// Cuts a run and calls take(part) for each part. If the run needs no cut, its items are only copied to the
// final buffer.
template <typename T, typename Take>
void cut_run(const ItemRun<T>& run, const Take& take) {
  const Side side = run.count > kTreeWidth ? longest_side(run) : Side{};
  if (!(side.length > 1e-290)) {  // few items, or all at the same position
    if (!run.in_place) std::copy_n(run.items, run.count, run.other);
    return;
  }
  const Cuts cuts(run.count);
  cut(run, side, cuts);
  for (std::size_t p = 0; p < cuts.parts; ++p)
    take(run.part(cuts.at[p], cuts.at[p + 1]));
}

template <typename T>
void sort_run(const ItemRun<T>& run) {
  cut_run(run, [](const ItemRun<T>& part) { sort_run(part); });
}

// Returns the number of runs into which the items are cut for the threads. A thread gets at least 8192 items,
// because sorting fewer items takes less time than starting a thread. Four runs per thread balance the load.
std::size_t runs_for(std::size_t threads, std::size_t items) {
  threads = std::min(threads, items / 8192);
  return threads > 1 ? 4 * threads : 1;
}

}  // namespace

template <typename T>
PositionedItem<T>* SpatialOrder<T>::reset(std::size_t count) {
  items_.resize(count);
  buffer_.resize(count);
  bins_.resize(count);
  return items_.data();
}

template <typename T>
void SpatialOrder<T>::sort(std::size_t count, const ParallelPolicy& policy) {
  runs_.assign(1, {items_.data(), buffer_.data(), bins_.data(), count, true});
  split_for_threads(runs_for(thread_count(policy), count), policy);
  for_each_chunk(policy, runs_.size(), [&](std::size_t r) { sort_run(runs_[r]); });
}

template <typename T>
void SpatialOrder<T>::split_for_threads(std::size_t runs, const ParallelPolicy& policy) {
  while (!runs_.empty() && runs_.size() < runs) {
    parts_.assign(runs_.size() * kMaxParts, {});
    for_each_chunk(policy, runs_.size(), [&](std::size_t r) {
      std::size_t p = r * kMaxParts;
      cut_run(runs_[r], [&](const ItemRun<T>& part) { parts_[p++] = part; });
    });
    runs_.clear();
    std::copy_if(parts_.begin(), parts_.end(), std::back_inserter(runs_),
                 [](const ItemRun<T>& part) { return part.count > 0; });
  }
}

template class detail::SpatialOrder<float>;
template class detail::SpatialOrder<double>;

}  // namespace pcl_bv
