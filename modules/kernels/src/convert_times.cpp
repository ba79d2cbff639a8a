// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/convert_times.h"

#include <cstring>
#include <limits>
#include <type_traits>

#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "convert_times.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Loads numbers as doubles, exactly.
template <class D, typename T>
HWY_INLINE V<D> load_numbers(D d, const T* numbers) {
  if constexpr (std::is_same_v<T, double>) {
    return hn::LoadU(d, numbers);
  } else if constexpr (std::is_same_v<T, float>) {
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), numbers));
  } else {
    // Highway 1.0.3 has no conversion of unsigned integers. With the exponent of 2^52, they are the mantissa.
    const hn::Rebind<std::uint64_t, D> bits;
    const auto mantissa = hn::PromoteTo(bits, hn::LoadU(hn::Rebind<std::uint32_t, D>(), numbers));
    const auto exponent = hn::BitCast(bits, hn::Set(d, 0x1p52));
    return hn::Sub(hn::BitCast(d, hn::Or(mantissa, exponent)), hn::Set(d, 0x1p52));
  }
}

// Returns the seconds of a packet. `inside` marks the times of the sweep.
template <class D>
HWY_INLINE hn::Vec<hn::Rebind<float, D>> convert_packet(D d, const TimeConversion& to, V<D> numbers,
                                                        hn::Mask<D>& inside) {
  const auto offset = hn::Sub(numbers, hn::Set(d, to.median));
  inside = hn::Le(hn::Abs(offset), hn::Set(d, to.max_offset));
  const auto time = hn::Sub(hn::Mul(offset, hn::Set(d, to.unit_seconds)), hn::Set(d, to.stamp_offset));
  return hn::DemoteTo(hn::Rebind<float, D>(), hn::IfThenElseZero(inside, time));
}

template <class D>
HWY_INLINE TimeLimits limits_of_lanes(D d, V<D> first, V<D> last) {
  return {hn::GetLane(hn::MinOfLanes(d, first)) + 0.F, hn::GetLane(hn::MaxOfLanes(d, last)) + 0.F};
}

// The times of a block are first copied to adjacent ones. The loads of a gather take longer.
template <typename T>
ConvertedTimes convert_of(const TimeRecords& records, const TimeConversion& to, float* seconds) {
  constexpr std::size_t kBlock = 256, kMaxLanes = kGroupBytes / sizeof(double);
  const Tag<double> d;
  const hn::Rebind<float, Tag<double>> df;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN T numbers[kBlock];
  hn::Mask<decltype(d)> inside;
  auto first = hn::Set(df, std::numeric_limits<float>::infinity()), last = hn::Neg(first);
  std::size_t inside_count = 0;
  for (std::size_t begin = 0; begin < records.count; begin += kBlock) {
    const std::size_t size = HWY_MIN(kBlock, records.count - begin);
    const std::byte* const data = records.data + begin * records.stride;
    for (std::size_t i = 0; i < size; ++i)
      std::memcpy(numbers + i, data + i * records.stride, sizeof(T));
    std::size_t i = 0;
    for (; i + lanes <= size; i += lanes) {
      const auto times = convert_packet(d, to, load_numbers(d, numbers + i), inside);
      hn::StoreU(times, df, seconds + begin + i);
      first = hn::Min(first, times);
      last = hn::Max(last, times);
      inside_count += hn::CountTrue(d, inside);
    }
    if (i == size) continue;
    // Repetitions of the last time fill the packet. They change no limit.
    for (std::size_t k = size; k < i + lanes; ++k)
      numbers[k] = numbers[size - 1];
    HWY_ALIGN float rest[kMaxLanes];
    const auto times = convert_packet(d, to, load_numbers(d, numbers + i), inside);
    hn::StoreU(times, df, rest);
    std::memcpy(seconds + begin + i, rest, (size - i) * sizeof(float));
    first = hn::Min(first, times);
    last = hn::Max(last, times);
    inside_count += hn::CountTrue(d, hn::And(inside, hn::FirstN(d, size - i)));
  }
  return {limits_of_lanes(df, first, last), records.count - inside_count};
}

ConvertedTimes convert_times(const TimeRecords& records, const TimeConversion& to, float* seconds) {
  if (records.type == TimeType::float32) return convert_of<float>(records, to, seconds);
  if (records.type == TimeType::float64) return convert_of<double>(records, to, seconds);
  return convert_of<std::uint32_t>(records, to, seconds);
}

// A comparison with NaN is false, and the limit remains. Min() of some sets would return NaN.
template <class D>
HWY_INLINE void include_times(V<D> times, V<D>& first, V<D>& last) {
  first = hn::IfThenElse(hn::Lt(times, first), times, first);
  last = hn::IfThenElse(hn::Gt(times, last), times, last);
}

// Each packet waits for the one before with the same limits. Two pairs of limits halve the time.
TimeLimits find_time_limits(const float* seconds, std::size_t count) {
  const Tag<float> d;
  using D = Tag<float>;
  const std::size_t lanes = hn::Lanes(d);
  const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
  auto first0 = infinity, first1 = infinity, last0 = hn::Neg(infinity), last1 = last0;
  std::size_t i = 0;
  for (; i + 2 * lanes <= count; i += 2 * lanes) {
    include_times<D>(hn::LoadU(d, seconds + i), first0, last0);
    include_times<D>(hn::LoadU(d, seconds + i + lanes), first1, last1);
  }
  for (; i < count; ++i)
    include_times<D>(hn::Set(d, seconds[i]), first0, last0);
  return limits_of_lanes(d, hn::Min(first0, first1), hn::Max(last0, last1));
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

ConvertedTimes convert_times(UsableIsa isa, const TimeRecords& records, const TimeConversion& to,
                             float* seconds) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(convert_times, &convert_times_reference);
  return records.count == 0 ? ConvertedTimes() : kTable[isa](records, to, seconds);
}

TimeLimits find_time_limits(UsableIsa isa, const float* seconds, std::size_t count) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(find_time_limits, &find_time_limits_reference);
  return count == 0 ? TimeLimits() : kTable[isa](seconds, count);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
