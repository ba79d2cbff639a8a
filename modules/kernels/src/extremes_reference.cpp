// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scalar reference: local accumulators and the paper's shared sums x + y and x - y, one point at a time, then
// a second look at the blocks that can hold an extreme. Compiled with -O3 -fno-tree-vectorize, so that it
// stays what benchmarks call scalar.

#include "extremes_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pcl_bv/kernels/chunks.h"

namespace pcl_bv {
namespace {

template <typename T>
constexpr T limit = sizeof(T) == 4 ? static_cast<T>(std::numeric_limits<float>::max())
                                   : static_cast<T>(1e100);

template <typename T>
bool valid(T x, T y, T z) {
  return std::abs(x) <= limit<T> && std::abs(y) <= limit<T> && std::abs(z) <= limit<T>;
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

// Least and greatest projection of one block's valid points, in the arithmetic of T.
template <typename T>
struct Block {
  T low[kMaxDirections];
  T high[kMaxDirections];
};

template <typename T, DirectionSet set, typename Load>
std::size_t project_block(std::size_t points, Load load, Block<T>& out) {
  constexpr std::size_t count = direction_count(set);
  T low[count];
  T high[count];
  std::fill_n(low, count, std::numeric_limits<T>::infinity());
  std::fill_n(high, count, -std::numeric_limits<T>::infinity());
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < points; ++i) {
    T v[3];
    load(i, v);
    // One test for nearly all: a sum that is small enough has valid terms.
    if (!(std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]) <= limit<T>)&&!valid(v[0], v[1], v[2])) {
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
  std::copy_n(low, count, out.low);
  std::copy_n(high, count, out.high);
  return dropped;
}

template <typename T, DirectionSet set>
std::size_t project_block(const PointView& points, Block<T>& out) {
  if (points.order == PointOrder::records && points.indices == nullptr) {
    const auto load = [data = points.data, stride = points.stride](std::size_t i, T(&v)[3]) {
      std::memcpy(v, data + stride * i, sizeof v);
    };
    return project_block<T, set>(points.count, load, out);
  }
  return project_block<T, set>(
      points.count, [&](std::size_t i, T(&v)[3]) { load_point(points, i, v); }, out);
}

template <typename T>
T reach(const Block<T>& block, std::size_t end) {
  return end % 2 == 0 ? -block.low[end / 2] : block.high[end / 2];
}

// How far the rounded projections of two points, of coordinates up to `magnitude` in sum, may be off
// together: u per addition for each, and once more for the difference itself and its rounding. Sums that may
// overflow say nothing.
template <typename T>
double doubt(int terms, double magnitude) {
  const double unit = sizeof(T) == 4 ? 0x1p-24 : 0x1p-53;
  if (terms == 1) return 0;
  if (magnitude > static_cast<double>(std::numeric_limits<T>::max())) {
    return std::numeric_limits<double>::infinity();
  }
  return (terms == 2 ? 4.1 : 6.1) * unit * magnitude;
}

template <typename T, DirectionSet set>
void extremes(const PointView& chunk, const ReachedEnds& reached, ChunkExtremes& out) {
  constexpr std::size_t ends = 2 * direction_count(set);
  Block<T> blocks[kChunkPoints / kBlockPoints];
  double top[ends];
  std::fill_n(top, ends, -std::numeric_limits<double>::infinity());
  out = ChunkExtremes();
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < chunk.count; begin += kBlockPoints, ++count) {
    const PointView block = chunk.slice(begin, std::min(kBlockPoints, chunk.count - begin));
    out.dropped += project_block<T, set>(block, blocks[count]);
    for (std::size_t end = 0; end < ends; ++end)
      top[end] = std::max<double>(top[end], reach(blocks[count], end));
  }
  if (out.dropped == chunk.count) return;
  double magnitude = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    magnitude += std::max(std::abs(top[2 * axis]), std::abs(top[2 * axis + 1]));
  for (std::size_t end = 0; end < ends; ++end) {
    const CubeDirection direction = end_direction(set, end);
    const double band = doubt<T>(term_count(direction), magnitude);
    if (top[end] + band < reached[end]) continue;
    const T least = static_cast<T>(top[end] - band);  // its rounding is in the band
    const RoundedFilter filter{{0, 0, 0}, std::isinf(band) ? -band : least};
    for (std::size_t b = 0; b < count; ++b) {
      if (!(reach(blocks[b], end) >= filter.threshold)) continue;
      const std::size_t begin = b * kBlockPoints;
      find_extreme_point(chunk, begin, 1, std::min(begin + kBlockPoints, chunk.count), direction, filter,
                         out.ends[end]);
    }
  }
}

template <typename T>
void extremes_of_set(const PointView& chunk, DirectionSet set, const ReachedEnds& reached,
                     ChunkExtremes& out) {
  switch (set) {
    case DirectionSet::dop6:
      return extremes<T, DirectionSet::dop6>(chunk, reached, out);
    case DirectionSet::dop14:
      return extremes<T, DirectionSet::dop14>(chunk, reached, out);
    case DirectionSet::dop18:
      return extremes<T, DirectionSet::dop18>(chunk, reached, out);
    case DirectionSet::dop26:
      return extremes<T, DirectionSet::dop26>(chunk, reached, out);
  }
}

template <typename T>
AxisExtents axis_extents_of(const PointView& points) {
  Block<T> block;
  AxisExtents out;
  out.dropped = project_block<T, DirectionSet::dop6>(points, block);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.low[axis] = block.low[axis] + 0.0;
    out.high[axis] = block.high[axis] + 0.0;
  }
  return out;
}

}  // namespace

void chunk_extremes_reference(const PointView& chunk, DirectionSet set, const ReachedEnds& reached,
                              ChunkExtremes& out) {
  if (chunk.scalar == ScalarType::float32) return extremes_of_set<float>(chunk, set, reached, out);
  extremes_of_set<double>(chunk, set, reached, out);
}

AxisExtents axis_extents_reference(const PointView& points) {
  return points.scalar == ScalarType::float32 ? axis_extents_of<float>(points)
                                              : axis_extents_of<double>(points);
}

}  // namespace pcl_bv
