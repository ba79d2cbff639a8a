// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for every instruction set, as the kernels are (docs/kernels.md).

#include "rivals.h"

#include <limits>

#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rivals.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::bench {
using namespace detail;
namespace HWY_NAMESPACE {
using namespace pcl_bv::detail::HWY_NAMESPACE;  // of load-inl.h
namespace hn = hwy::HWY_NAMESPACE;

// Named variables, not arrays: vectors of SVE have no size that the compiler knows.
#define PCL_BV_EACH_ACCUMULATOR(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#define PCL_BV_DECLARE(k)                                                             \
  const std::uint64_t* const p##k = words + (k % streams) * part + (k / streams) * n; \
  auto sum##k = hn::Zero(d);
#define PCL_BV_STEP(k) sum##k = hn::Xor(sum##k, hn::LoadU(d, p##k + i));
#define PCL_BV_KEEP(k) total = hn::Xor(total, sum##k);

// Eight accumulators, each reading every eighth vector of its stream's part.
template <unsigned streams>
std::uint64_t read_streams(const std::uint64_t* words, std::size_t count) {
  const hn::ScalableTag<std::uint64_t> d;
  const std::size_t n = hn::Lanes(d);
  const std::size_t step = 8 / streams * n;
  const std::size_t part = count / streams / step * step;
  PCL_BV_EACH_ACCUMULATOR(PCL_BV_DECLARE)
  for (std::size_t i = 0; i < part; i += step) {
    PCL_BV_EACH_ACCUMULATOR(PCL_BV_STEP)
  }
  auto total = hn::Zero(d);
  PCL_BV_EACH_ACCUMULATOR(PCL_BV_KEEP)
  HWY_ALIGN std::uint64_t lanes[HWY_MAX_BYTES / sizeof(std::uint64_t)];
  hn::Store(total, d, lanes);
  std::uint64_t result = 0;
  for (std::size_t i = 0; i < n; ++i)
    result ^= lanes[i];
  for (std::size_t i = streams * part; i < count; ++i)
    result ^= words[i];
  return result;
}

#undef PCL_BV_EACH_ACCUMULATOR
#undef PCL_BV_DECLARE
#undef PCL_BV_STEP
#undef PCL_BV_KEEP

std::uint64_t read_words(const std::uint64_t* words, std::size_t count, unsigned streams) {
  switch (streams) {
    case 1:
      return read_streams<1>(words, count);
    case 2:
      return read_streams<2>(words, count);
    case 4:
      return read_streams<4>(words, count);
    default:
      return read_streams<8>(words, count);
  }
}

#if HWY_TARGET != HWY_SCALAR

template <class D>
void keep(D d, V<D> low, V<D> high, std::size_t k, UncheckedExtents& out) {
  out.low[k] = hn::GetLane(hn::MinOfLanes(d, low));
  out.high[k] = hn::GetLane(hn::MaxOfLanes(d, high));
}

// Four registers of whole points at a time; the axes part at the end, as in the library.
UncheckedExtents unchecked_aabb(const PointView& points) {
  const Tag<float> d;
  const std::size_t n = hn::Lanes(d);
  const float* p = reinterpret_cast<const float*>(points.data);
  auto low0 = hn::LoadU(d, p), low1 = hn::LoadU(d, p), low2 = hn::LoadU(d, p), low3 = hn::LoadU(d, p);
  auto high0 = low0, high1 = low1, high2 = low2, high3 = low3;
  for (const float* const end = p + 4 * points.count; p != end; p += 4 * n) {
    const auto a = hn::LoadU(d, p), b = hn::LoadU(d, p + n);
    const auto c = hn::LoadU(d, p + 2 * n), e = hn::LoadU(d, p + 3 * n);
    low0 = hn::Min(low0, a), high0 = hn::Max(high0, a);
    low1 = hn::Min(low1, b), high1 = hn::Max(high1, b);
    low2 = hn::Min(low2, c), high2 = hn::Max(high2, c);
    low3 = hn::Min(low3, e), high3 = hn::Max(high3, e);
  }
  HWY_ALIGN float lows[HWY_MAX_BYTES / sizeof(float)];
  HWY_ALIGN float highs[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(hn::Min(hn::Min(low0, low1), hn::Min(low2, low3)), d, lows);
  hn::Store(hn::Max(hn::Max(high0, high1), hn::Max(high2, high3)), d, highs);
  UncheckedExtents out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.low[axis] = lows[axis], out.high[axis] = highs[axis];
    for (std::size_t lane = axis; lane < n; lane += 4) {
      out.low[axis] = HWY_MIN(out.low[axis], lows[lane]);
      out.high[axis] = HWY_MAX(out.high[axis], highs[lane]);
    }
  }
  return out;
}

// clang-format off
#define PCL_BV_EACH_DIRECTION(DO)                                                                 \
  DO(0, x) DO(1, y) DO(2, z)                                                                      \
  DO(3, hn::Add(sum, z)) DO(4, hn::Sub(sum, z)) DO(5, hn::Add(difference, z)) DO(6, hn::Sub(difference, z)) \
  DO(7, sum) DO(8, difference)                                                                    \
  DO(9, hn::Add(x, z)) DO(10, hn::Sub(x, z)) DO(11, hn::Add(y, z)) DO(12, hn::Sub(y, z))
// clang-format on
#define PCL_BV_DECLARE(k, projection)                          \
  auto low##k = hn::Set(d, std::numeric_limits<float>::max()); \
  auto high##k = hn::Set(d, std::numeric_limits<float>::lowest());
#define PCL_BV_STEP(k, projection) \
  {                                \
    const auto p = projection;     \
    low##k = hn::Min(low##k, p);   \
    high##k = hn::Max(high##k, p); \
  }
#define PCL_BV_KEEP(k, projection) keep(d, low##k, high##k, k, out);

// Zero times a sum that is not finite is NaN; without fused products the sums themselves are added.
template <class D>
HWY_INLINE V<D> add_test(D d, V<D> sum, V<D> test) {
#if HWY_NATIVE_FMA
  return hn::MulAdd(sum, hn::Zero(d), test);
#else
  (void)d;
  return hn::Add(test, sum);
#endif
}

template <bool tested>
UncheckedExtents dop26(const PointView& points) {
  const Tag<float> d;
  auto test = hn::Zero(d);
  PCL_BV_EACH_DIRECTION(PCL_BV_DECLARE)
  for (std::size_t i = 0; i < points.count; i += hn::Lanes(d)) {
    V<decltype(d)> x, y, z;
    load_packet<Layout::packed16>(d, points, i, x, y, z);
    const auto sum = hn::Add(x, y);
    const auto difference = hn::Sub(x, y);
    if constexpr (tested) test = add_test(d, hn::Add(sum, z), test);
    PCL_BV_EACH_DIRECTION(PCL_BV_STEP)
  }
  UncheckedExtents out;
  PCL_BV_EACH_DIRECTION(PCL_BV_KEEP)
  const auto total = hn::SumOfLanes(d, hn::Sub(test, test));
  if (hn::GetLane(total) != 0) out.low.fill(hn::GetLane(total));
  return out;
}

UncheckedExtents unchecked_dop26(const PointView& points) {
  return dop26<false>(points);
}
UncheckedExtents tested_dop26(const PointView& points) {
  return dop26<true>(points);
}

#undef PCL_BV_EACH_DIRECTION
#undef PCL_BV_DECLARE
#undef PCL_BV_STEP
#undef PCL_BV_KEEP

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::bench {
using namespace detail;

std::uint64_t read_words(Isa isa, const std::uint64_t* words, std::size_t count, unsigned streams) {
  static constexpr KernelTable<std::uint64_t(const std::uint64_t*, std::size_t, unsigned)> kTable =
      PCL_BV_KERNEL_TABLE(read_words, &N_SCALAR::read_words);
  return kTable[isa](words, count, streams);
}

UncheckedExtents unchecked_aabb(Isa isa, const PointView& points) {
  static constexpr KernelTable<UncheckedExtents(const PointView&)> kTable =
      PCL_BV_KERNEL_TABLE(unchecked_aabb, nullptr);
  return kTable[isa](points);
}

UncheckedExtents unchecked_dop26(Isa isa, const PointView& points) {
  static constexpr KernelTable<UncheckedExtents(const PointView&)> kTable =
      PCL_BV_KERNEL_TABLE(unchecked_dop26, nullptr);
  return kTable[isa](points);
}

UncheckedExtents tested_dop26(Isa isa, const PointView& points) {
  static constexpr KernelTable<UncheckedExtents(const PointView&)> kTable =
      PCL_BV_KERNEL_TABLE(tested_dop26, nullptr);
  return kTable[isa](points);
}

}  // namespace pcl_bv::bench
#endif  // HWY_ONCE
