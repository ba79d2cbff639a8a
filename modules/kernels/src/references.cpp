// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The scalar references except those of supports and axis extents (support_reference.cpp), of times
// (times_reference.cpp) and of trees (tree_reference.cpp). They are compiled with -O3 -fno-tree-vectorize,
// because benchmarks use them as the scalar baseline.

#include "references.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "distance_squared.h"
#include "region_tests.h"
#include "run_extremes.h"
#include "screw_motion.h"

namespace pcl_bv::detail {
namespace {

// Calls call.operator()<T>() with the view's scalar type.
template <typename Call>
auto for_scalar(const PointView& points, const Call& call) {
  if (points.scalar == ScalarType::float64) return call.template operator()<double>();
  return call.template operator()<float>();
}

// Writes the positions below `points` for which listed(position) holds. Returns their number.
template <typename Listed>
std::size_t list_if(std::size_t points, std::uint32_t* positions, const Listed& listed) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points; ++i) {
    if (listed(i)) positions[count++] = static_cast<std::uint32_t>(i);
  }
  return count;
}

template <typename T>
bool is_inside(const T (&p)[3], const HalfSpaces& inside) {
  const T x = p[0] - static_cast<T>(inside.center.x);
  const T y = p[1] - static_cast<T>(inside.center.y);
  const T z = p[2] - static_cast<T>(inside.center.z);
  if ((x * x + y * y) + z * z < static_cast<T>(inside.squared_ball)) return true;
  for (std::size_t k = 0; k < inside.count; ++k) {
    const HalfSpace& h = inside.planes[k];
    const T projection = (static_cast<T>(h.x) * x + static_cast<T>(h.y) * y) + static_cast<T>(h.z) * z;
    if (!(projection < static_cast<T>(h.limit))) return false;
  }
  return inside.count > 0;
}

template <typename T>
T screw_series(std::size_t k, T s) {
  const auto& c = kScrewSeries[k];
  T sum = static_cast<T>(c[3]);
  for (std::size_t i = 3; i-- > 0;)
    sum = static_cast<T>(c[i]) + s * sum;
  return sum;
}

template <typename T>
void move_point(const ScrewMotion<T>& motion, T t, T (&p)[3]) {
  if (p[0] == 0 && p[1] == 0 && p[2] == 0) return;
  const T tt = t * t, s = motion.ww * tt;
  const T a = t * screw_series(0, s), b = tt * screw_series(1, s), c = (tt * t) * screw_series(2, s);
  const auto cross = [&](const T(&q)[3], std::size_t i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    return motion.w[j] * q[k] - motion.w[k] * q[j];
  };
  const T once[3] = {cross(p, 0), cross(p, 1), cross(p, 2)};
  T moved[3];
  for (std::size_t i = 0; i < 3; ++i)
    moved[i] =
        p[i] + (a * once[i] + (b * (cross(once, i) + motion.wv[i]) + (t * motion.v[i] + c * motion.wwv[i])));
  if (is_valid(Coordinates{moved[0], moved[1], moved[2]})) std::copy_n(moved, 3, p);
}

void sum_block(const PointView& block, Moments& out) {
  constexpr std::size_t kLanes = 8;
  double lanes[kLanes][9] = {};
  const double scale = std::ldexp(1.0, out.exponent);
  for (std::size_t i = 0; i < block.count; ++i) {
    const Coordinates p = load_point(block, i);
    if (!is_valid(p)) continue;
    const double x = (p.x - out.origin.x) * scale;
    const double y = (p.y - out.origin.y) * scale;
    const double z = (p.z - out.origin.z) * scale;
    const double terms[] = {x, y, z, x * x, x * y, x * z, y * y, y * z, z * z};
    for (std::size_t k = 0; k < 9; ++k)
      lanes[i % kLanes][k] += terms[k];
  }
  out.sum = {};
  out.product = {};
  for (const auto& lane : lanes) {
    for (std::size_t k = 0; k < 9; ++k)
      (k < 3 ? out.sum[k] : out.product[k - 3]) += lane[k];
  }
}

template <typename T>
T along(const T (&n)[3], const T (&q)[3]) {
  return (n[0] * q[0] + n[1] * q[1]) + n[2] * q[2];
}

template <typename T>
RegionState state_of(T value, T inner, T outer) {
  return value <= inner ? RegionState::inside : value > outer ? RegionState::outside : RegionState::unclear;
}

template <typename T>
RegionState state_in_body(const RegionTest<T>& test, const T (&q)[3]) {
  if (test.shape == RegionShape::ball) return state_of(along(q, q), test.square_inner, test.square_outer);
  T excess = -std::numeric_limits<T>::infinity(), squares = 0;
  for (const SlabTest<T>& slab : test.slabs) {
    const T projection = std::abs(along(slab.axis, q));
    const T part = std::max(projection - slab.core, T(0)) * slab.weight;
    excess = std::max(excess, projection - slab.slab);
    squares += part * part;
  }
  const RegionState flat = state_of(excess, -test.error, test.error);
  if (test.shape == RegionShape::slabs || flat == RegionState::outside) return flat;
  const RegionState round = state_of(squares, test.square_inner, test.square_outer);
  return round == RegionState::inside ? flat : round;
}

template <typename T>
RegionState state_in_planes(const RegionTest<T>& test, const T (&q)[3]) {
  const T error_bound = ((std::abs(q[0]) + std::abs(q[1])) + std::abs(q[2])) * test.slope;
  RegionState state = RegionState::inside;
  for (const PlaneTest<T>& plane : test.planes) {
    const T projection = along(plane.normal, q);
    if (projection - error_bound > plane.outer) return RegionState::outside;
    if (!(projection + error_bound <= plane.inner)) state = RegionState::unclear;
  }
  return state;
}

template <typename T>
RegionState state_in(const RegionTest<T>& test, const T (&p)[3]) {
  const bool by_head =
      !test.undecidable && test.shape != RegionShape::box && test.shape != RegionShape::planes;
  T q[3];
  for (std::size_t k = 0; k < 3; ++k) {
    q[k] = p[k] - test.head[k];
    const bool in_box = by_head ? test.shape == RegionShape::ball || std::abs(q[k]) <= test.max_offset[k]
                                : p[k] >= test.low[k] && p[k] <= test.high[k];
    if (!in_box) return RegionState::outside;
    q[k] -= test.tail[k];
  }
  if (test.undecidable) return RegionState::unclear;
  if (test.shape == RegionShape::box) return RegionState::inside;
  return test.shape == RegionShape::planes ? state_in_planes(test, q) : state_in_body(test, q);
}

// test(k) returns the k-th of the `count` regions to be tested.
template <typename T, typename Test>
RegionState state_of_point(const RegionTestsOf<T>& all, std::size_t count, const Test& test,
                           const T (&p)[3]) {
  RegionState result = RegionState::outside;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(p[k] >= all.low[k] && p[k] <= all.high[k])) return result;
  }
  for (std::size_t k = 0; k < count; ++k) {
    const RegionState state = state_in(test(k), p);
    if (state != RegionState::outside) result = state;
    if (state == RegionState::inside) break;
  }
  return result;
}

// Updates the maximum of the point's octant if the point is valid and not nearer than the limit.
void compete(const Coordinates& p, OctantScan& scan) {
  const double d2 = distance_squared(p, scan.center);
  if (!(d2 >= scan.limit) || !is_valid(p)) return;
  double& best = scan.max_squared[octant(p, scan.center)];
  best = std::max(best, d2);
}

void grow(const std::array<Direction, 3>& axes, double x, double y, double z, SlabExtents& all) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double s = (axes[k][0] * x + axes[k][1] * y) + axes[k][2] * z;
    all.low[k] = std::min(all.low[k], s);
    all.high[k] = std::max(all.high[k], s);
  }
}

void store_offsets(const PointView& block, const Moments& moments, BlockOffsets& offsets) {
  offsets.count = moments.count == 0 ? 0 : (block.count + 7) / 8 * 8;
  const Coordinates& o = moments.origin;
  for (std::size_t i = 0; i < offsets.count; ++i) {
    const Coordinates p = i < block.count ? load_point(block, i) : o;
    const bool valid = is_valid(p);
    offsets.x[i] = valid ? p.x - o.x : 0;
    offsets.y[i] = valid ? p.y - o.y : 0;
    offsets.z[i] = valid ? p.z - o.z : 0;
  }
}

}  // namespace

void deskew_reference(const PointView& points, const float* seconds, const SensorMotion& motion,
                      std::byte* xyz) {
  for_scalar(points, [&]<typename T>() {
    const ScrewMotion<T> screw(motion);
    for (std::size_t i = 0; i < points.count; ++i) {
      T p[3];
      load_point(points, i, p);
      move_point(screw, static_cast<T>(seconds[i]), p);
      std::memcpy(xyz + i * sizeof p, p, sizeof p);
    }
  });
}

void transform_points_reference(const PointView& points, const RigidTransform& transform, std::byte* xyz) {
  for_scalar(points, [&]<typename T>() {
    for (std::size_t i = 0; i < points.count; ++i) {
      T p[3], moved[3];
      load_point(points, i, p);
      for (std::size_t row = 0; row < 3; ++row) {
        const std::array<double, 4>& m = transform[row];
        moved[row] =
            ((static_cast<T>(m[0]) * p[0] + static_cast<T>(m[1]) * p[1]) + static_cast<T>(m[2]) * p[2]) +
            static_cast<T>(m[3]);
      }
      const bool no_return = p[0] == 0 && p[1] == 0 && p[2] == 0;
      if (no_return || !is_valid({p[0], p[1], p[2]}) || !is_valid({moved[0], moved[1], moved[2]}))
        std::fill_n(moved, 3, std::numeric_limits<T>::quiet_NaN());
      std::memcpy(xyz + i * sizeof moved, moved, sizeof moved);
    }
  });
}

std::size_t list_outside_reference(const PointView& points, const HalfSpaces& inside,
                                   std::uint32_t* positions) {
  return for_scalar(points, [&]<typename T>() {
    return list_if(points.count, positions, [&](std::size_t i) {
      T p[3];
      load_point(points, i, p);
      return !is_inside(p, inside);
    });
  });
}

void region_states_reference(const PointView& points, const RegionTests::Prepared& regions,
                             std::uint8_t* states) {
  for_scalar(points, [&]<typename T>() {
    const RegionTestsOf<T>& all = regions.of<T>();
    const auto test = [&](std::size_t k) -> const RegionTest<T>& { return all.regions[k]; };
    for (std::size_t i = 0; i < points.count; ++i) {
      T p[3];
      load_point(points, i, p);
      states[i] = static_cast<std::uint8_t>(state_of_point(all, all.regions.size(), test, p));
    }
  });
}

void chosen_states_reference(const PointView& points, const RegionTests::Prepared& regions,
                             const ChosenRegions& chosen, std::uint8_t* states) {
  for_scalar(points, [&]<typename T>() {
    const RegionTestsOf<T>& all = regions.of<T>();
    const auto test = [&](std::size_t k) -> const RegionTest<T>& { return all.regions[chosen.indices[k]]; };
    for (std::size_t i = 0; i < points.count; ++i) {
      T p[3];
      load_point(points, i, p);
      states[i] = static_cast<std::uint8_t>(state_of_point(all, chosen.count, test, p));
    }
  });
}

void run_boxes_reference(const PointView& points, RunBox* boxes) {
  for_scalar(points, [&]<typename T>() {
    for (std::size_t begin = 0; begin < points.count; begin += kRunPoints) {
      RunExtremes<T> extremes;
      for (std::size_t i = begin; i < std::min(begin + kRunPoints, points.count); ++i) {
        T p[3];
        load_point(points, i, p);
        for (std::size_t k = 0; k < 3; ++k) {
          extremes.low[k] = p[k] < extremes.low[k] ? p[k] : extremes.low[k];
          extremes.high[k] = p[k] > extremes.high[k] ? p[k] : extremes.high[k];
        }
      }
      boxes[begin / kRunPoints] = extremes.box();
    }
  });
}

SlabExtents slab_extents_reference(const PointView& points, const Coordinates& origin,
                                   const std::array<Direction, 3>& axes) {
  SlabExtents result;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    grow(axes, p.x - origin.x, p.y - origin.y, p.z - origin.z, result);
  }
  return result;
}

SlabExtents slab_extents_of_offsets_reference(const BlockOffsets& offsets,
                                              const std::array<Direction, 3>& axes) {
  SlabExtents result;
  for (std::size_t i = 0; i < offsets.count; ++i)
    grow(axes, offsets.x[i], offsets.y[i], offsets.z[i], result);
  return result;
}

void fill_groups_reference(const PointView& points, std::size_t pad, std::byte* groups) {
  for_scalar(points, [&]<typename T>() {
    constexpr std::size_t lanes = kGroupBytes / sizeof(T);
    const std::size_t end = (points.count + lanes - 1) / lanes * lanes;
    for (std::size_t i = 0; i < end; ++i) {
      T v[3];
      load_point(points, i < points.count ? i : pad, v);
      std::byte* group = groups + i / lanes * (3 * kGroupBytes);
      for (std::size_t axis = 0; axis < 3; ++axis)
        std::memcpy(group + axis * kGroupBytes + i % lanes * sizeof(T), &v[axis], sizeof(T));
    }
  });
}

Moments block_moments_reference(const PointView& block, BlockOffsets* offsets) {
  Moments out;
  for (std::size_t i = 0; i < block.count; ++i) {
    const Coordinates p = load_point(block, i);
    if (!is_valid(p)) continue;
    if (out.count == 0) out.origin = p;
    ++out.count;
  }
  if (out.count > 0)
    sum_without_underflow(block.scalar, out, [&](Moments& moments) { sum_block(block, moments); });
  if (offsets != nullptr) store_offsets(block, out, *offsets);
  return out;
}

double squared_distance(const Coordinates& p, const DistanceCenter& center) {
  return distance_squared(p, center);
}

std::size_t octant(const Coordinates& p, const DistanceCenter& center) {
  const auto bit = [&](double coordinate, double origin) {
    return static_cast<std::size_t>((coordinate - origin) * center.scale > 0);
  };
  return bit(p.x, center.x) | bit(p.y, center.y) << 1 | bit(p.z, center.z) << 2;
}

void scan_octants_reference(const PointView& block, OctantScan& scan) {
  scan.max_squared.fill(-1);
  for_scalar(block, [&]<typename T>() {
    for (std::size_t i = 0; i < block.count; ++i)
      compete(load_as<T>(block, i), scan);
  });
}

// The bounds only save time, so the reference ignores them.
std::size_t list_distant_by_bounds_reference(const PointView& block, const ScanBounds& /*scanned*/,
                                             const DistanceCenter& center, double limit,
                                             std::uint32_t* positions) {
  return list_if(block.count, positions,
                 [&](std::size_t i) { return distance_squared(load_as<float>(block, i), center) >= limit; });
}

std::size_t list_distant_reference(const PointView& points, const DistanceCenter& center, double limit,
                                   FloatFilter /*filter*/, std::uint32_t* positions) {
  return for_scalar(points, [&]<typename T>() {
    return list_if(points.count, positions, [&](std::size_t i) {
      const Coordinates p = load_as<T>(points, i);
      return distance_squared(p, center) >= limit && is_valid(p);
    });
  });
}

}  // namespace pcl_bv::detail
