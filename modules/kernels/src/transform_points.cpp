// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/transform_points.h"

#include <cstring>
#include <limits>

#include "preconditions.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transform_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

template <class D>
HWY_INLINE V<D> transformed_coordinate(D d, const std::array<double, 4>& row, V<D> x, V<D> y, V<D> z) {
  using T = hn::TFromD<D>;
  const auto factor = [&](std::size_t i) { return hn::Set(d, static_cast<T>(row[i])); };
  const auto xy = hn::Add(hn::Mul(factor(0), x), hn::Mul(factor(1), y));
  return hn::Add(hn::Add(xy, hn::Mul(factor(2), z)), factor(3));
}

template <class D>
HWY_INLINE void transform_packet(D d, const RigidTransform& m, V<D>& x, V<D>& y, V<D>& z) {
  const auto to_x = transformed_coordinate(d, m[0], x, y, z), to_y = transformed_coordinate(d, m[1], x, y, z),
             to_z = transformed_coordinate(d, m[2], x, y, z);
  const auto zero = hn::Zero(d);
  const auto no_return = hn::And(hn::And(hn::Eq(x, zero), hn::Eq(y, zero)), hn::Eq(z, zero));
  const auto valid =
      hn::AndNot(no_return, hn::And(valid_lanes(d, x, y, z), valid_lanes(d, to_x, to_y, to_z)));
  const auto nan = hn::Set(d, std::numeric_limits<hn::TFromD<D>>::quiet_NaN());
  x = hn::IfThenElse(valid, to_x, nan);
  y = hn::IfThenElse(valid, to_y, nan);
  z = hn::IfThenElse(valid, to_z, nan);
}

template <Layout layout, typename T>
void transform_of(const PointView& points, const RigidTransform& transform, std::byte* xyz) {
  const Tag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  T* const out = reinterpret_cast<T*>(xyz);
  V<decltype(d)> x, y, z;
  std::size_t i = 0;
  for (; i + lanes <= points.count; i += lanes) {
    load_packet_in_order<layout>(d, points, i, x, y, z);
    transform_packet(d, transform, x, y, z);
    hn::StoreInterleaved3(x, y, z, d, out + 3 * i);
  }
  const std::size_t rest = points.count - i;
  if (rest == 0) return;
  constexpr std::size_t kMaxLanes = kGroupBytes / sizeof(T);
  const T pad[3] = {};
  HWY_ALIGN T moved[3 * kMaxLanes];
  load_padded(d, points, i, rest, pad, x, y, z);
  transform_packet(d, transform, x, y, z);
  hn::StoreInterleaved3(x, y, z, d, moved);
  std::memcpy(out + 3 * i, moved, 3 * rest * sizeof(T));
}

void transform_points(const PointView& points, const RigidTransform& transform, std::byte* xyz) {
  for_layout(points, [&]<Layout layout, typename T>() { transform_of<layout, T>(points, transform, xyz); });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

void transform_points(UsableIsa isa, const PointView& points, const RigidTransform& transform,
                      std::byte* xyz) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(transform_points, &transform_points_reference);
  require_in_memory(points);
  kTable[isa](points, transform, xyz);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
