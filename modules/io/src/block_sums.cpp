// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "block_sums.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

// Only the first cache line of every 4 KiB is summed. If another cloud replaces the cloud, these lines differ
// as well. Summing them costs 1 % of the cheapest pass over a file in the page cache. Summing all bytes would
// cost half of the pass.
constexpr std::size_t kStride = 4096;

// Each step must wait for the previous step of its lane, so eight independent lanes are computed at the same
// time. Each step is a bijection, so a change of a single word always changes the lane.
std::uint16_t sum_of(const std::byte* from, std::size_t bytes) {
  constexpr std::size_t kLanes = 8;
  constexpr std::uint64_t odd = 0x9E3779B97F4A7C15;
  std::uint64_t lanes[kLanes] = {1, 2, 3, 4, 5, 6, 7, 8}, words[kLanes] = {};
  for (std::size_t at = 0; at < bytes; at += kStride) {
    if (bytes - at >= sizeof words) {
      std::memcpy(words, from + at, sizeof words);
    } else {
      std::memcpy(words, from + at, bytes - at);
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      lanes[lane] = std::rotl(lanes[lane] ^ words[lane], 29) * odd;
  }
  std::uint64_t all = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    all += std::rotl(lanes[lane], static_cast<int>(8 * lane));
  return std::max<std::uint16_t>(1, static_cast<std::uint16_t>(all * odd >> 48));
}

}  // namespace

BlockSums::BlockSums(std::size_t points)
    : points_(points), sums_((points + kBlockPoints - 1) / kBlockPoints) {}

void BlockSums::check(std::size_t first, std::size_t count, const std::byte* records, std::size_t step) {
  const std::size_t end = first + count;
  for (std::size_t block = (first + kBlockPoints - 1) / kBlockPoints; block < sums_.size(); ++block) {
    const std::size_t begin = block * kBlockPoints, stop = std::min(begin + kBlockPoints, points_);
    if (stop > end) return;
    const std::uint16_t sum = sum_of(records + (begin - first) * step, (stop - begin) * step);
    std::uint16_t before = sums_[block].load(std::memory_order_relaxed);
    if (before == 0) sums_[block].compare_exchange_strong(before, sum, std::memory_order_relaxed);
    if (before != 0 && before != sum) throw IoError(kChangedWhileRead);
  }
}

}  // namespace pcl_bv::detail
