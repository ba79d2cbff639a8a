// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scalar reference: local accumulators and the paper's shared sums x + y and x - y, one point at a time.
// Compiled with -O3 -fno-tree-vectorize, so that it stays what benchmarks call scalar.

#include "extents_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_bv {
namespace {

template <typename T>
bool valid(T x, T y, T z) {
  const T limit = sizeof(T) == 4 ? std::numeric_limits<T>::max() : static_cast<T>(1e100);
  return std::abs(x) <= limit && std::abs(y) <= limit && std::abs(z) <= limit;
}

template <typename T, DirectionSet set>
void project(T x, T y, T z, T (&p)[kMaxDirections]) {
  std::size_t k = 0;
  p[k++] = x;
  p[k++] = y;
  p[k++] = z;
  if constexpr (set == DirectionSet::dop6) return;
  const T sum = x + y;
  const T difference = x - y;
  if constexpr (set != DirectionSet::dop18) {
    p[k++] = sum + z;
    p[k++] = sum - z;
    p[k++] = difference + z;
    p[k++] = difference - z;
  }
  if constexpr (set != DirectionSet::dop14) {
    p[k++] = sum;
    p[k++] = difference;
    p[k++] = x + z;
    p[k++] = x - z;
    p[k++] = y + z;
    p[k++] = y - z;
  }
}

template <typename T, DirectionSet set>
void reference_block(const PointView& points, BlockExtents& out) {
  constexpr std::size_t count = direction_count(set);
  T low[count];
  T high[count];
  std::fill_n(low, count, std::numeric_limits<T>::infinity());
  std::fill_n(high, count, -std::numeric_limits<T>::infinity());
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    T v[3];
    std::memcpy(v, points.address(i), sizeof v);
    if (!valid(v[0], v[1], v[2])) {
      ++dropped;
      continue;
    }
    T p[kMaxDirections];
    project<T, set>(v[0], v[1], v[2], p);
    for (std::size_t k = 0; k < count; ++k) {
      low[k] = p[k] < low[k] ? p[k] : low[k];
      high[k] = p[k] > high[k] ? p[k] : high[k];
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    out.low[k] = low[k] + 0.0;
    out.high[k] = high[k] + 0.0;
  }
  out.dropped = dropped;
}

template <typename T, DirectionSet set>
void reference_blocks(const PointView& points, BlockExtents* blocks) {
  for (std::size_t begin = 0; begin < points.count; begin += kBlockPoints) {
    reference_block<T, set>(points.slice(begin, std::min(kBlockPoints, points.count - begin)), *blocks++);
  }
}

template <typename T>
void reference_set(const PointView& points, DirectionSet set, BlockExtents* blocks) {
  switch (set) {
    case DirectionSet::dop6:
      return reference_blocks<T, DirectionSet::dop6>(points, blocks);
    case DirectionSet::dop14:
      return reference_blocks<T, DirectionSet::dop14>(points, blocks);
    case DirectionSet::dop18:
      return reference_blocks<T, DirectionSet::dop18>(points, blocks);
    case DirectionSet::dop26:
      return reference_blocks<T, DirectionSet::dop26>(points, blocks);
  }
}

}  // namespace

void block_extents_reference(const PointView& points, DirectionSet set, BlockExtents* blocks) {
  if (points.scalar == ScalarType::float32) return reference_set<float>(points, set, blocks);
  reference_set<double>(points, set, blocks);
}

}  // namespace pcl_bv
