// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The thresholds are derived in docs/numerics.md.

#include "region_tests.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"

namespace pcl_bv::detail {
namespace {

// Error bound relative to |q|_1 or to a radius. It covers the rounding in T and the errors of the caller's
// numbers.
template <typename T>
constexpr double kSlope = 16 * (sizeof(T) == 4 ? 0x1p-24 : kUnitRoundoff) + 0x1p-42;

template <typename T>
constexpr double kSmallestDenormal = static_cast<double>(std::numeric_limits<T>::denorm_min());

template <typename T>
T up(double x) {
  if constexpr (sizeof(T) == 4) {
    return float_up(x);
  } else {
    return x;
  }
}

template <typename T>
T down(double x) {
  return -up<T>(-x);
}

template <typename T>
constexpr double kMost = sizeof(T) == 4 ? static_cast<double>(std::numeric_limits<float>::max())
                                        : kMaxCoordinate;

template <typename T>
void set_box(const ConvexRegion& region, RegionTest<T>& test) {
  for (std::size_t k = 0; k < 3; ++k) {
    test.low[k] = up<T>(std::max(region.low[k], -kMost<T>));
    test.high[k] = down<T>(std::min(region.high[k], kMost<T>));
  }
}

// Returns the largest |q[k]| of the points of the box, where q = p - center.
double max_offset(const ConvexRegion& region, std::size_t k) {
  return std::max(region.center[k] - region.low[k], region.high[k] - region.center[k]);
}

// Sets the centre. Returns an error bound of a distance, without the part of the error that depends on the
// point.
template <typename T>
double set_center(const ConvexRegion& region, RegionTest<T>& test) {
  double lost = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    test.head[k] = static_cast<T>(region.center[k]);
    const double rest = region.center[k] - static_cast<double>(test.head[k]);
    test.tail[k] = static_cast<T>(rest);
    test.max_offset[k] =
        up<T>((max_offset(region, k) + std::abs(rest)) * (1 + kSlope<T>)+2 * kSmallestDenormal<T>);
    lost += std::abs(rest - static_cast<double>(test.tail[k])) + kSlope<T> * std::abs(rest);
  }
  // The last term covers the 2^-500 that Sphere::contains() adds to a radius.
  return 2 * lost + region.surface_error + 16 * kSmallestDenormal<T> + 0x1p-500;
}

template <typename T>
void set_body(const ConvexRegion& region, double off, RegionTest<T>& test) {
  double extent = 0, position = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    extent += max_offset(region, k);
    position += std::abs(region.center[k]);
  }
  test.undecidable = !(extent + position < kMost<T> / 16);
  const double error = off + kSlope<T> * extent;
  test.error = up<T>(error);
  for (std::size_t i = 0; i < 3; ++i) {
    SlabTest<T>& slab = test.slabs[i];
    for (std::size_t k = 0; k < 3; ++k)
      slab.axis[k] = static_cast<T>(region.axes[i][k]);
    slab.slab = static_cast<T>(region.slab[i]);
    slab.core = static_cast<T>(region.core[i]);
    slab.weight = static_cast<T>(region.weight[i]);
  }
  const double steepest = std::max({region.weight[0], region.weight[1], region.weight[2]});
  const double error_bound = 2 * steepest * error + 4 * kSmallestDenormal<T>;
  const double narrow = (region.radius - error_bound) * (1 - kSlope<T>);
  const double wide = (region.radius + error_bound) * (1 + kSlope<T>);
  test.square_inner =
      narrow > 0 ? down<T>(narrow * narrow * (1 - 0x1p-50) - 8 * kSmallestDenormal<T>) : T(-1);
  test.square_outer = up<T>(wide * wide * (1 + 0x1p-50) + 8 * kSmallestDenormal<T>);
}

template <typename T>
void set_planes(const ConvexRegion& region, double off, RegionTest<T>& test) {
  test.slope = up<T>(kSlope<T>);
  for (const HalfSpace& h : region.planes) {
    test.planes.push_back({{static_cast<T>(h.x), static_cast<T>(h.y), static_cast<T>(h.z)},
                           down<T>(h.limit - off),
                           up<T>(h.limit + off)});
  }
}

template <typename T>
RegionTestsOf<T> prepare(const std::vector<ConvexRegion>& regions) {
  constexpr T infinity = std::numeric_limits<T>::infinity();
  RegionTestsOf<T> all{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, {}};
  for (const ConvexRegion& region : regions) {
    RegionTest<T> test{};
    test.shape = region.shape;
    set_box(region, test);
    const double off = set_center(region, test);
    if (region.shape == RegionShape::planes) {
      set_planes(region, off, test);
    } else if (region.shape != RegionShape::box) {
      set_body(region, off, test);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      all.low[k] = std::min(all.low[k], test.low[k]);
      all.high[k] = std::max(all.high[k], test.high[k]);
    }
    all.regions.push_back(std::move(test));
  }
  return all;
}

}  // namespace

RegionTests::RegionTests(const std::vector<ConvexRegion>& regions) {
  prepared_ = std::make_shared<const Prepared>(Prepared{prepare<float>(regions), prepare<double>(regions)});
}

}  // namespace pcl_bv::detail
