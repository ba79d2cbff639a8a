// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scalar references of supports and axis extents. They project one point at a time into local accumulators.
// Projections on the cube's directions share the sums x + y and x - y. The reference of supports then
// searches the blocks that can have a support point. This source is compiled with -O3 -fno-tree-vectorize,
// because benchmarks use it as the scalar baseline.

#include <algorithm>
#include <cmath>
#include <limits>

#include "pcl_bv/points/point_source.h"
#include "references.h"

namespace pcl_bv::detail {
namespace {

template <typename T>
constexpr T limit = sizeof(T) == 4 ? static_cast<T>(std::numeric_limits<float>::max())
                                   : static_cast<T>(1e100);

// Projects on the cube's directions, in the points' scalar type.
template <DirectionSet set>
struct CubeProjections {
  static constexpr std::size_t count = direction_count(set);

  template <typename T>
  void operator()(T x, T y, T z, T* p) const {
    *p++ = x;
    *p++ = y;
    *p++ = z;
    if constexpr (set == DirectionSet::dop6) return;
    const T sum = x + y;
    const T difference = x - y;
    if constexpr (set != DirectionSet::dop18) {
      *p++ = sum + z;
      *p++ = sum - z;
      *p++ = difference + z;
      *p++ = difference - z;
    }
    if constexpr (set != DirectionSet::dop14) {
      *p++ = sum;
      *p++ = difference;
      *p++ = x + z;
      *p++ = x - z;
      *p++ = y + z;
      *p++ = y - z;
    }
  }
};

// Projects on any directions, in double. The first three projections are on the axes; their extremes give the
// largest magnitudes of the coordinates.
struct GeneralProjections {
  const SupportDirections& set;
  std::size_t count = 3 + set.count;

  void operator()(double x, double y, double z, double* p) const {
    *p++ = x;
    *p++ = y;
    *p++ = z;
    for (std::size_t k = 0; k < set.count; ++k)
      *p++ = (set.scaled[k][0] * x + set.scaled[k][1] * y) + set.scaled[k][2] * z;
  }
};

// Minimum and maximum projections of the valid points of a block.
template <typename T>
struct Block {
  T low[3 + kMaxSupportDirections] = {};
  T high[3 + kMaxSupportDirections] = {};

  double support_value(std::size_t support) const {
    return support % 2 == 0 ? -low[support / 2] : high[support / 2];
  }
};

template <typename T, typename Project, typename Load>
std::size_t project_block(std::size_t points, const Load& load, const Project& project, Block<T>& out) {
  T low[3 + kMaxSupportDirections];
  T high[3 + kMaxSupportDirections];
  std::fill_n(low, project.count, std::numeric_limits<T>::infinity());
  std::fill_n(high, project.count, -std::numeric_limits<T>::infinity());
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < points; ++i) {
    T v[3];
    load(i, v);
    const T x = std::abs(v[0]), y = std::abs(v[1]), z = std::abs(v[2]);
    // The first test is sufficient for nearly all points. If the sum is small enough, its terms are valid.
    if (!(x + y + z <= limit<T>)&&!(x <= limit<T> && y <= limit<T> && z <= limit<T>)) {
      ++dropped;
      continue;
    }
    T p[3 + kMaxSupportDirections];
    project(v[0], v[1], v[2], p);
    for (std::size_t k = 0; k < project.count; ++k) {
      low[k] = p[k] < low[k] ? p[k] : low[k];
      high[k] = p[k] > high[k] ? p[k] : high[k];
    }
  }
  std::copy_n(low, project.count, out.low);
  std::copy_n(high, project.count, out.high);
  return dropped;
}

// T may be double for float points.
template <typename T, typename Project>
std::size_t project_block(const PointView& points, const Project& project, Block<T>& out) {
  const bool stored = points.scalar == (sizeof(T) == 4 ? ScalarType::float32 : ScalarType::float64);
  if (stored && points.order == PointOrder::records && points.indices == nullptr) {
    const auto load = [data = points.data, stride = points.stride](std::size_t i, T(&v)[3]) {
      std::memcpy(v, data + stride * i, sizeof v);
    };
    return project_block<T>(points.count, load, project, out);
  }
  const auto load = [&](std::size_t i, T(&v)[3]) {
    const Coordinates p = load_point(points, i);
    v[0] = static_cast<T>(p.x), v[1] = static_cast<T>(p.y), v[2] = static_cast<T>(p.z);
  };
  return project_block<T>(points.count, load, project, out);
}

// Returns an error bound of the difference of the projections of two points whose coordinates are at most `m`
// in magnitude. For the cube's directions, let u be the unit roundoff of T. Each of the two points
// contributes one u per addition and one u for the rounding of the difference. The bound is infinite if sums
// may overflow. For other directions, the error of each projection is at most 3.01 * 2^-53 of the magnitudes.
// The bound also covers the underflow of products and of the direction's tiny components.
template <typename T>
double pair_error(const SupportDirections& set, std::size_t k, const Coordinates& m) {
  const Direction& d = set.scaled[k];
  const double size = (std::abs(d[0]) * m.x + std::abs(d[1]) * m.y) + std::abs(d[2]) * m.z;
  if (!set.cube) return 0x1p-50 * size + (0x1p-1072 * (m.x + m.y + m.z) + std::numeric_limits<double>::min());
  const int terms = (d[0] != 0) + (d[1] != 0) + (d[2] != 0);
  if (terms == 1) return 0;
  if (size > static_cast<double>(std::numeric_limits<T>::max()))
    return std::numeric_limits<double>::infinity();
  return (terms == 2 ? 4.1 : 6.1) * (sizeof(T) == 4 ? 0x1p-24 : 0x1p-53) * size;
}

void search(const PointView& block, const SupportDirections& set, std::size_t support, double threshold,
            SupportPoint& best) {
  const Direction exact = set.support_direction(support), d = set.scaled_support_direction(support);
  for (std::size_t i = 0; i < block.count; ++i) {
    const Coordinates p = load_point(block, i);
    if (!is_valid(p) || (d[0] * p.x + d[1] * p.y) + d[2] * p.z < threshold) continue;
    keep_larger_projection(exact, {true, p, block.index(i)}, best);
  }
}

// `first` is the number of the first support of `set` in a Block. It is 0 for CubeProjections, and 6 for
// GeneralProjections, which projects on the three axes first.
template <typename T, typename Project>
void supports(const PointView& chunk, const SupportDirections& set, const Project& project, std::size_t first,
              const SupportBounds& bounds, ChunkSupports& out) {
  Block<T> blocks[kChunkPoints / kBlockPoints];
  const std::size_t count = block_count(chunk.count);
  for (std::size_t b = 0; b < count; ++b)
    out.dropped += project_block(block_of(chunk, b), project, blocks[b]);
  if (out.dropped == chunk.count) return;
  const auto top = [&](std::size_t support) {
    double greatest = blocks[0].support_value(support);
    for (std::size_t b = 1; b < count; ++b)
      greatest = std::max(greatest, blocks[b].support_value(support));
    return greatest;
  };
  const auto magnitude = [&](std::size_t axis) {
    return std::max(std::abs(top(2 * axis)), std::abs(top(2 * axis + 1)));
  };
  const Coordinates greatest{magnitude(0), magnitude(1), magnitude(2)};
  for (std::size_t support = 0; support < 2 * set.count; ++support) {
    const double maximum = top(first + support), error = pair_error<T>(set, support / 2, greatest);
    if (maximum + error < bounds[support]) continue;
    const double threshold = std::isinf(error) ? -error : maximum - error;
    for (std::size_t b = 0; b < count; ++b) {
      if (blocks[b].support_value(first + support) >= threshold)
        search(block_of(chunk, b), set, support, threshold, out.supports[support]);
    }
  }
}

template <DirectionSet cube>
void supports_of(const PointView& chunk, const SupportDirections& set, const SupportBounds& bounds,
                 ChunkSupports& out) {
  if (chunk.scalar == ScalarType::float32)
    return supports<float>(chunk, set, CubeProjections<cube>(), 0, bounds, out);
  supports<double>(chunk, set, CubeProjections<cube>(), 0, bounds, out);
}

template <typename T>
AxisExtents axis_extents_of(const PointView& points) {
  Block<T> block;
  AxisExtents out;
  out.dropped = project_block(points, CubeProjections<DirectionSet::dop6>(), block);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.low[axis] = block.low[axis] + 0.0;
    out.high[axis] = block.high[axis] + 0.0;
  }
  return out;
}

}  // namespace

void chunk_supports_reference(const PointView& chunk, const SupportDirections& set,
                              const SupportBounds& bounds, ChunkSupports& out) {
  if (!set.cube) return supports<double>(chunk, set, GeneralProjections{set}, 6, bounds, out);
  switch (*set.cube) {
    case DirectionSet::dop6:
      return supports_of<DirectionSet::dop6>(chunk, set, bounds, out);
    case DirectionSet::dop14:
      return supports_of<DirectionSet::dop14>(chunk, set, bounds, out);
    case DirectionSet::dop18:
      return supports_of<DirectionSet::dop18>(chunk, set, bounds, out);
    case DirectionSet::dop26:
      return supports_of<DirectionSet::dop26>(chunk, set, bounds, out);
  }
}

AxisExtents axis_extents_reference(const PointView& points) {
  return points.scalar == ScalarType::float32 ? axis_extents_of<float>(points)
                                              : axis_extents_of<double>(points);
}

}  // namespace pcl_bv::detail
