// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Loads points into packets (vectors of x, y and z), for the target being compiled.

// Compiled once per target of Highway's foreach_target.h.
#if defined(PCL_BV_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_LOAD_INL_H_
#undef PCL_BV_LOAD_INL_H_
#else
#define PCL_BV_LOAD_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <limits>

#include "pcl_bv/points/point_view.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// The vector type of all kernels. Vectors are as wide as the machine's registers, but at most kGroupBytes
/// wide.
template <typename T>
using Tag = hn::CappedTag<T, kGroupBytes / sizeof(T)>;

template <class D>
using V = hn::Vec<D>;

/// The largest coordinate that is_valid() allows.
template <typename T>
constexpr T coordinate_limit() {
  return sizeof(T) == 4 ? static_cast<T>(std::numeric_limits<float>::max()) : static_cast<T>(kMaxCoordinate);
}

/// Returns a mask of the valid points.
template <class D>
HWY_INLINE hn::Mask<D> valid_lanes(D d, V<D> x, V<D> y, V<D> z) {
  const auto limit = hn::Set(d, coordinate_limit<hn::TFromD<D>>());
  return hn::And(hn::And(hn::Le(hn::Abs(x), limit), hn::Le(hn::Abs(y), limit)), hn::Le(hn::Abs(z), limit));
}

/// How a packet is loaded. layout_of() tests what a layout requires of the view.
enum class Layout {
  groups,    ///< each vector of x, y or z is contiguous
  packed12,  ///< float, contiguous: x y z x y z ...
  packed16,  ///< float, contiguous records of 16 bytes (pcl::PointXYZ)
  wide,      ///< float, 16 readable bytes per point, any stride or an index list
  narrow,    ///< float, 12 readable bytes per point, any stride or an index list
  pairs,     ///< double, any stride or an index list
  any        ///< loaded coordinate by coordinate
};

template <typename T>
Layout layout_of(const PointView& points) {
  if (points.order == PointOrder::groups) {
    const bool aligned = points.first % (kGroupBytes / sizeof(T)) == 0;
    return points.indices == nullptr && aligned ? Layout::groups : Layout::any;
  }
  const bool contiguous = points.indices == nullptr && points.stride == points.readable;
  if (sizeof(T) == 4 && contiguous && points.stride == 12) return Layout::packed12;
  if (sizeof(T) == 4 && contiguous && points.stride == 16) return Layout::packed16;
  if (HWY_HAVE_SCALABLE) return Layout::any;
  if (sizeof(T) == 8) return Layout::pairs;
  return points.readable >= 16 ? Layout::wide : Layout::narrow;
}

/// Calls call.operator()<layout, T>() with the view's layout and scalar type.
template <typename Call>
auto for_layout(const PointView& points, const Call& call) {
  if (points.scalar == ScalarType::float64) {
    switch (layout_of<double>(points)) {
      case Layout::groups:
        return call.template operator()<Layout::groups, double>();
      case Layout::pairs:
        return call.template operator()<Layout::pairs, double>();
      default:
        return call.template operator()<Layout::any, double>();
    }
  }
  switch (layout_of<float>(points)) {
    case Layout::groups:
      return call.template operator()<Layout::groups, float>();
    case Layout::packed12:
      return call.template operator()<Layout::packed12, float>();
    case Layout::packed16:
      return call.template operator()<Layout::packed16, float>();
    case Layout::wide:
      return call.template operator()<Layout::wide, float>();
    case Layout::narrow:
      return call.template operator()<Layout::narrow, float>();
    default:
      return call.template operator()<Layout::any, float>();
  }
}

/// Returns the number, in a packet of `lanes` points, of the point that load_packet() loads into a lane.
template <Layout layout>
std::size_t point_of_lane(std::size_t lane, std::size_t lanes) {
  if (layout == Layout::packed16 && !HWY_HAVE_SCALABLE) return lane % 4 * (lanes / 4) + lane / 4;
  return lane;
}

// Loads one 128-bit block from each of the points first, first + step, ... The block starts `bytes` bytes
// after the point's x. The recursion halves the vector until it has one block.
template <class D>
HWY_INLINE V<D> load_blocks(D d, const PointView& points, std::size_t first, std::size_t step,
                            std::size_t bytes) {
  using T = hn::TFromD<D>;
  if constexpr (hn::MaxLanes(D()) * sizeof(T) <= 16) {
    return hn::LoadU(d, reinterpret_cast<const T*>(points.address(first) + bytes));
  } else {
    const hn::Half<D> half;
    const std::size_t blocks = hn::Lanes(half) * sizeof(T) / 16;
    return hn::Combine(d, load_blocks(half, points, first + blocks * step, step, bytes),
                       load_blocks(half, points, first, step, bytes));
  }
}

// Loads x, y and z of one point as x, y, z, z, and reads no byte after z.
template <class D>
HWY_INLINE V<D> load_three(D d, const std::byte* x) {
  const hn::Repartition<double, D> pairs;
  double xy;
  float z;
  std::memcpy(&xy, x, sizeof xy);
  std::memcpy(&z, x + sizeof xy, sizeof z);
  return hn::BitCast(d, hn::InterleaveLower(pairs, hn::Set(pairs, xy), hn::BitCast(pairs, hn::Set(d, z))));
}

/// Loads the points first, first + step, ... as x, y, z and a fourth number of any value. For the layouts
/// wide and narrow.
template <Layout layout, class D>
HWY_INLINE V<D> load_whole_points(D d, const PointView& points, std::size_t first, std::size_t step) {
  if constexpr (layout == Layout::wide) {
    return load_blocks(d, points, first, step, 0);
  } else if constexpr (hn::MaxLanes(D()) <= 4) {
    return load_three(d, points.address(first));
  } else {
    const hn::Half<D> half;
    const std::size_t count = hn::Lanes(half) / 4;
    return hn::Combine(d, load_whole_points<layout>(half, points, first + count * step, step),
                       load_whole_points<layout>(half, points, first, step));
  }
}

// Turns four registers of whole points (x, y, z and a fourth lane of any value) into registers of x, y and z.
// This is a transpose inside each 128-bit block and takes seven shuffles.
template <class D>
HWY_INLINE void transpose(D d, V<D> a, V<D> b, V<D> c, V<D> e, V<D>& x, V<D>& y, V<D>& z) {
  const hn::Repartition<double, D> pairs;
  const auto ab_xy = hn::BitCast(pairs, hn::InterleaveLower(d, a, b));
  const auto ab_zw = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
  const auto ce_xy = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
  const auto ce_zw = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
  x = hn::BitCast(d, hn::InterleaveLower(pairs, ab_xy, ce_xy));
  y = hn::BitCast(d, hn::InterleaveUpper(pairs, ab_xy, ce_xy));
  z = hn::BitCast(d, hn::InterleaveLower(pairs, ab_zw, ce_zw));
}

/// Loads the `count` points from `first` on, at most one packet, point by point and in order. The other lanes
/// hold the point `pad`.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void load_padded(D d, const PointView& points, std::size_t first, std::size_t count, const T* pad,
                            V<D>& x, V<D>& y, V<D>& z) {
  HWY_ALIGN T lanes[3][kGroupBytes / sizeof(T)];
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    T v[3] = {};
    if (i < count) {
      load_point(points, first + i, v);
    } else {
      std::memcpy(v, pad, sizeof v);
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      lanes[axis][i] = v[axis];
  }
  x = hn::Load(d, lanes[0]);
  y = hn::Load(d, lanes[1]);
  z = hn::Load(d, lanes[2]);
}

/// Loads a full packet of points from `first` on, in the order of point_of_lane().
template <Layout layout, class D>
HWY_INLINE void load_packet(D d, const PointView& points, std::size_t first, V<D>& x, V<D>& y, V<D>& z) {
  using T = hn::TFromD<D>;
  const std::size_t n = hn::Lanes(d);
  if constexpr (layout == Layout::groups) {
    const T* p = reinterpret_cast<const T*>(points.address(first));
    x = hn::LoadU(d, p);
    y = hn::LoadU(d, p + kGroupBytes / sizeof(T));
    z = hn::LoadU(d, p + 2 * kGroupBytes / sizeof(T));
  } else if constexpr (layout == Layout::packed12) {
    hn::LoadInterleaved3(d, reinterpret_cast<const T*>(points.data) + 3 * first, x, y, z);
  } else if constexpr (layout == Layout::packed16) {
    const T* p = reinterpret_cast<const T*>(points.data) + 4 * first;
#if HWY_HAVE_SCALABLE
    V<D> rest;
    hn::LoadInterleaved4(d, p, x, y, z, rest);
#else
    transpose(d, hn::LoadU(d, p), hn::LoadU(d, p + n), hn::LoadU(d, p + 2 * n), hn::LoadU(d, p + 3 * n), x, y,
              z);
#endif
#if !HWY_HAVE_SCALABLE
  } else if constexpr (layout == Layout::wide || layout == Layout::narrow) {
    transpose(d, load_whole_points<layout>(d, points, first, 4),
              load_whole_points<layout>(d, points, first + 1, 4),
              load_whole_points<layout>(d, points, first + 2, 4),
              load_whole_points<layout>(d, points, first + 3, 4), x, y, z);
  } else if constexpr (layout == Layout::pairs) {
    const V<D> even = load_blocks(d, points, first, 2, 0);
    const V<D> odd = load_blocks(d, points, first + 1, 2, 0);
    x = hn::InterleaveLower(d, even, odd);
    y = hn::InterleaveUpper(d, even, odd);
    z = hn::InterleaveUpper(d, load_blocks(d, points, first, 2, sizeof(T)),
                            load_blocks(d, points, first + 1, 2, sizeof(T)));
#endif
  } else {
    load_padded(d, points, first, n, static_cast<const T*>(nullptr), x, y, z);
  }
}

/// Same as load_packet(), but `first` may be any point. In groups, a vector that starts in the middle of a
/// packet could extend from one coordinate into the next coordinate. The points of such a packet are
/// therefore loaded one by one.
template <Layout layout, class D>
HWY_INLINE void load_packet_anywhere(D d, const PointView& points, std::size_t first, V<D>& x, V<D>& y,
                                     V<D>& z) {
  if (layout == Layout::groups && HWY_UNLIKELY(first % hn::Lanes(d) != 0)) {
    return load_packet<Layout::any>(d, points, first, x, y, z);
  }
  load_packet<layout>(d, points, first, x, y, z);
}

/// Same as load_packet(), but lane i holds point first + i.
template <Layout layout, class D>
HWY_INLINE void load_packet_in_order(D d, const PointView& points, std::size_t first, V<D>& x, V<D>& y,
                                     V<D>& z) {
  load_packet<layout>(d, points, first, x, y, z);
#if !HWY_HAVE_SCALABLE
  constexpr std::size_t lanes = hn::MaxLanes(D());
  if constexpr (layout == Layout::packed16 && lanes > 4) {
    // The inverse of point_of_lane(). Needs three more shuffles than loading each point by itself, but takes
    // half of its time (Zen 4, AVX-512).
    HWY_ALIGN std::int32_t lane_of_point[lanes];
    for (std::size_t i = 0; i < lanes; ++i)
      lane_of_point[i] = static_cast<std::int32_t>(i % (lanes / 4) * 4 + i / (lanes / 4));
    const auto order = hn::SetTableIndices(d, lane_of_point);
    x = hn::TableLookupLanes(x, order);
    y = hn::TableLookupLanes(y, order);
    z = hn::TableLookupLanes(z, order);
  }
#endif
}

/// Loads `count` points from `first` on, in order; `count` is less than a packet and may be 0. The other
/// lanes hold the point `pad`.
template <Layout layout, class D, typename T = hn::TFromD<D>>
HWY_INLINE void load_tail_in_order(D d, const PointView& points, std::size_t first, std::size_t count,
                                   const T* pad, V<D>& x, V<D>& y, V<D>& z) {
  if constexpr (layout == Layout::packed16) {
    HWY_ALIGN T copy[4 * (kGroupBytes / sizeof(T))] = {};
    if (count > 0)
      std::memcpy(copy, reinterpret_cast<const T*>(points.data) + 4 * first, count * 4 * sizeof(T));
    const PointView copied = PointView::of(copy, 4 * sizeof(T), hn::Lanes(d));
    load_packet_in_order<layout>(d, copied, 0, x, y, z);
    const auto loaded = hn::FirstN(d, count);
    x = hn::IfThenElse(loaded, x, hn::Set(d, pad[0]));
    y = hn::IfThenElse(loaded, y, hn::Set(d, pad[1]));
    z = hn::IfThenElse(loaded, z, hn::Set(d, pad[2]));
  } else {
    load_padded(d, points, first, count, pad, x, y, z);
  }
}

/// Loads the packet from `first` on. An incomplete last packet is loaded in order and padded with the view's
/// first point.
template <Layout layout, class D, typename T = hn::TFromD<D>>
HWY_INLINE void load_packet_or_tail(D d, const PointView& points, std::size_t first, V<D>& x, V<D>& y,
                                    V<D>& z) {
  if (first + hn::Lanes(d) <= points.count) {
    load_packet<layout>(d, points, first, x, y, z);
    return;
  }
  T pad[3];
  load_point(points, 0, pad);
  load_padded(d, points, first, points.count - first, pad, x, y, z);
}

/// Returns a mask as bits; lane 0 is the lowest bit.
template <class D>
HWY_INLINE std::uint64_t bits_of_mask(D d, hn::Mask<D> mask) {
  HWY_ALIGN std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof bytes; ++i)
    bits |= std::uint64_t{bytes[i]} << 8 * i;
  return bits;
}

/// Appends the positions of the marked points of a packet, which was loaded by load_packet_or_tail(). The
/// lowest bit of `marked` is lane 0. `positions` has `count` entries before the call. Returns the number of
/// entries after the call.
template <Layout layout, class D>
std::size_t append_marked(D d, std::uint64_t marked, const PointView& points, std::size_t first,
                          std::uint32_t* positions, std::size_t count) {
  const std::size_t lanes = hn::Lanes(d), left = points.count - first;
  std::uint64_t by_point = 0;
  for (std::uint64_t bits = marked; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    by_point |= std::uint64_t{1} << (lanes <= left ? point_of_lane<layout>(lane, lanes) : lane);
  }
  if (left < lanes) by_point &= (std::uint64_t{1} << left) - 1;
  for (; by_point != 0; by_point &= by_point - 1)
    positions[count++] =
        static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(std::countr_zero(by_point));
  return count;
}

/// Loads the packet from `first` on and subtracts the centre. If `masked`, the centre replaces invalid points
/// and fills the lanes past the end of the block. valid_count then grows by the number of valid points plus
/// the number of lanes past the end. If not `masked`, lanes past the end hold the centre or repeat points,
/// which changes no minimum or maximum.
template <Layout layout, bool masked, class D, typename T = hn::TFromD<D>>
HWY_INLINE void load_relative(D d, const PointView& block, std::size_t first, const T* center, V<D>& x,
                              V<D>& y, V<D>& z, [[maybe_unused]] std::size_t& valid_count) {
  const std::size_t n = hn::Lanes(d);
  const auto center_x = hn::Set(d, center[0]);
  const auto center_y = hn::Set(d, center[1]);
  const auto center_z = hn::Set(d, center[2]);
  if (HWY_LIKELY(first + n <= block.count)) {
    load_packet<layout>(d, block, first, x, y, z);
  } else if (masked || block.count < n) {
    load_padded(d, block, first, block.count - first, center, x, y, z);
  } else {
    load_packet_anywhere<layout>(d, block, block.count - n, x, y, z);
  }
  if constexpr (masked) {
    const auto valid = valid_lanes(d, x, y, z);
    valid_count += hn::CountTrue(d, valid);
    x = hn::IfThenElse(valid, x, center_x);
    y = hn::IfThenElse(valid, y, center_y);
    z = hn::IfThenElse(valid, z, center_z);
  }
  x = hn::Sub(x, center_x);
  y = hn::Sub(y, center_y);
  z = hn::Sub(z, center_z);
}

/// Prefetches the memory of a packet 8 KiB ahead. Without prefetching, a loop with much arithmetic per packet
/// fills the core's reorder window, and loads of later packets start too late. A 26-DOP of 1 M points on
/// AVX-512 runs at 2.9 Gpt/s with prefetching and at 0.9 Gpt/s without. Other layouts are not prefetched.
/// With prefetching, clouds of pcl::PointXYZI (Layout::wide) in the second-level cache would run at 0.9
/// instead of 1.8 Gpt/s, and clouds in memory would gain only 15 %.
template <Layout layout, class D>
HWY_INLINE void prefetch_ahead(D d, const PointView& points, std::size_t first) {
  if constexpr (layout == Layout::groups || layout == Layout::packed12 || layout == Layout::packed16) {
    const std::size_t bytes = hn::Lanes(d) * (layout == Layout::packed16 ? 16 : 3 * sizeof(hn::TFromD<D>));
    const auto ahead =
        reinterpret_cast<std::uintptr_t>(points.address(first)) + 8192;  // harmless if past the array
    for (std::size_t line = 0; line < bytes; line += 64)
      __builtin_prefetch(reinterpret_cast<const void*>(ahead + line));
  }
}

/// Keeps a loop's integer accumulator in its register. Without this, g++ 12 does not see that the float
/// vector and the integer vector share one register, and copies and spills the accumulator. Keeping it in the
/// register increases the speed from 2600 to 4500 Mpt/s (26-DOP, AVX-512).
template <class Vector>
HWY_INLINE void keep_in_register(Vector& v) {
#if HWY_ARCH_X86
  asm("" : "+v"(v.raw));
#else
  (void)v;
#endif
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
