// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/convert_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv::detail {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(),
                kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kCounts[] = {1, 2, 3, 7, 8, 9, 15, 16, 17, 255, 256, 257, 261, 512, 5003};

template <typename T>
constexpr TimeType kTypeOf = std::is_same_v<T, float>    ? TimeType::float32
                             : std::is_same_v<T, double> ? TimeType::float64
                                                         : TimeType::uint32;

// Records of `stride` bytes with the time at the end, and exactly as much memory.
template <typename T>
std::vector<std::byte> records_of(const std::vector<T>& times, std::size_t stride) {
  std::vector<std::byte> bytes(times.size() * stride, std::byte{0xA5});
  for (std::size_t i = 0; i < times.size(); ++i)
    std::memcpy(bytes.data() + (i + 1) * stride - sizeof(T), &times[i], sizeof(T));
  return bytes;
}

template <typename T>
TimeRecords view_of(const std::vector<std::byte>& bytes, std::size_t stride) {
  return {bytes.data() + stride - sizeof(T), stride, bytes.size() / stride, kTypeOf<T>};
}

// Times of a sweep, those at both limits, their neighbours, and for floating-point types NaN and infinities.
template <typename T>
std::vector<T> times_of_a_sweep(const TimeConversion& to, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> offset(-1.2 * to.max_offset, 1.2 * to.max_offset);
  std::vector<T> special{static_cast<T>(to.median - to.max_offset), static_cast<T>(to.median + to.max_offset),
                         static_cast<T>(to.median), std::numeric_limits<T>::max(), T{0}};
  if constexpr (std::is_floating_point_v<T>) {
    for (const T limit : {special[0], special[1]})
      for (const T side : {-std::numeric_limits<T>::infinity(), std::numeric_limits<T>::infinity()})
        special.push_back(std::nextafter(limit, side));
    special.insert(special.end(), {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity(),
                                   -std::numeric_limits<T>::infinity(), std::numeric_limits<T>::denorm_min(),
                                   std::numeric_limits<T>::lowest(), -T{0}});
  } else {
    for (const T limit : {special[0], special[1]})
      special.insert(special.end(), {limit - 1, limit + 1});
  }
  std::vector<T> times;
  for (std::size_t i = 0; i < count; ++i)
    times.push_back(random() % 3 == 0 ? special[random() % special.size()]
                                      : static_cast<T>(to.median + offset(random)));
  return times;
}

struct Expected {
  std::vector<float> seconds;
  float first = 0, last = 0;
  std::size_t outside = 0;
};

template <typename T>
Expected by_definition(const std::vector<T>& times, const TimeConversion& to) {
  Expected expected;
  for (const T time : times) {
    const double offset = static_cast<double>(time) - to.median;
    const bool inside = std::abs(offset) <= to.max_offset;
    const float seconds = inside ? static_cast<float>(offset * to.unit_seconds - to.stamp_offset) : 0.F;
    expected.outside += !inside;
    if (expected.seconds.empty()) expected.first = expected.last = seconds;
    expected.first = std::min(expected.first, seconds);
    expected.last = std::max(expected.last, seconds);
    expected.seconds.push_back(seconds);
  }
  return expected;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

template <typename T>
void expect_the_definition(const TimeConversion& to) {
  const FloatEnvironment environment;
  for (const std::size_t count : kCounts) {
    const std::vector<T> times = times_of_a_sweep<T>(to, count, 100 + count);
    const Expected expected = by_definition(times, to);
    for (const std::size_t stride : {sizeof(T), std::size_t{16}, std::size_t{22}, std::size_t{48}}) {
      const std::vector<std::byte> bytes = records_of(times, stride);
      for (const Isa isa : usable_isas()) {
        SCOPED_TRACE(std::string(isa_name(isa)) + ", seed and count " + std::to_string(count) + ", stride " +
                     std::to_string(stride));
        std::vector<float> seconds(count + 16, -7);
        const ConvertedTimes found = convert_times(isa, view_of<T>(bytes, stride), to, seconds.data());
        for (std::size_t i = count; i < seconds.size(); ++i)
          ASSERT_EQ(seconds[i], -7) << "written after the last time";
        seconds.resize(count);
        EXPECT_TRUE(same_bits(seconds, expected.seconds));
        EXPECT_EQ(found.limits.first, expected.first);
        EXPECT_EQ(found.limits.last, expected.last);
        EXPECT_FALSE(std::signbit(found.limits.first) && found.limits.first == 0);
        EXPECT_EQ(found.outside, expected.outside);
      }
    }
  }
}

TEST(ConvertTimes, GivesTheBitsOfTheDefinitionOnEverySetForEveryTypeAndStride) {
  expect_the_definition<std::uint32_t>({5e7, 1e-9, -0.05, 4e7});         // nanoseconds after the stamp
  expect_the_definition<std::uint32_t>({4.2e9, 1e-9, 0.01, 5e7});        // numbers of 2^31 and more
  expect_the_definition<float>({0.05F, 1, -0.05F, 0.04F});               // seconds after the stamp
  expect_the_definition<float>({0, 1e-3, 0, 50});                        // milliseconds about the stamp
  expect_the_definition<double>({1.7e9 + 0.05, 1, 0.0123, 0.25});        // seconds since 1970
  expect_the_definition<double>({1.7e18 + 5e7, 1e-9, -0.0123456, 5e7});  // nanoseconds since 1970
}

// The product is 1 + 2^-29 + 2^-60, and its rounding loses the last term.
TEST(ConvertTimes, RoundsTheProductBeforeItSubtractsOnEverySet) {
  const FloatEnvironment environment;
  const double factor = 1 + 0x1p-30, product = factor * factor;
  const std::vector<double> times(19, factor);
  for (const Isa isa : usable_isas()) {
    std::vector<float> seconds(times.size(), -7);
    const TimeRecords records{reinterpret_cast<const std::byte*>(times.data()), sizeof(double), times.size(),
                              TimeType::float64};
    convert_times(isa, records, {0, factor, product, 2}, seconds.data());
    EXPECT_EQ(seconds, std::vector<float>(times.size(), 0)) << isa_name(isa);
  }
}

TEST(ConvertTimes, OfNoRecordsHasLimitsOfZero) {
  for (const Isa isa : usable_isas()) {
    const ConvertedTimes none = convert_times(isa, {}, {}, nullptr);
    EXPECT_EQ(none.limits.first, 0) << isa_name(isa);
    EXPECT_EQ(none.limits.last, 0) << isa_name(isa);
    EXPECT_EQ(none.outside, 0U) << isa_name(isa);
  }
}

TEST(FindTimeLimits, GivesTheSmallestAndLargestTimeOnEverySetAndIgnoresNaN) {
  for (const std::size_t count : kCounts) {
    std::mt19937_64 random(count);
    std::uniform_real_distribution<float> time(-0.1F, 0.1F);
    for (std::size_t round = 0; round < 20; ++round) {
      std::vector<float> seconds(count);
      for (float& each : seconds)
        each = random() % 4 == 0 ? kNaN : time(random);
      seconds[random() % count] = random() % 2 == 0 ? 0.2F : -0.2F;
      float first = kInfinity, last = -kInfinity;
      for (const float each : seconds) {
        if (std::isnan(each)) continue;
        first = std::min(first, each);
        last = std::max(last, each);
      }
      for (const Isa isa : usable_isas()) {
        const TimeLimits limits = find_time_limits(isa, seconds.data(), count);
        EXPECT_EQ(limits.first, first) << isa_name(isa) << ", seed and count " << count << ", " << round;
        EXPECT_EQ(limits.last, last) << isa_name(isa) << ", seed and count " << count << ", " << round;
      }
    }
  }
}

TEST(FindTimeLimits, AreInfiniteIfNoTimeIsANumberAndZeroWithoutTimes) {
  const std::vector<float> nan(37, kNaN);
  for (const Isa isa : usable_isas()) {
    const TimeLimits of_nan = find_time_limits(isa, nan.data(), nan.size()),
                     none = find_time_limits(isa, nullptr, 0);
    EXPECT_EQ(of_nan.first, kInfinity) << isa_name(isa);
    EXPECT_EQ(of_nan.last, -kInfinity) << isa_name(isa);
    EXPECT_EQ(none.first, 0) << isa_name(isa);
    EXPECT_EQ(none.last, 0) << isa_name(isa);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
