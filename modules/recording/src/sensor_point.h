// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes points with few instructions. The compiler writes each member by itself, because the library is
// built without the vectorisation of straight-line code; decoders spend most of their time in these writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "pcl_bv/recording/packet_reader.h"

namespace pcl_bv::detail {

using Double2 = double __attribute__((vector_size(16)));

/// Returns two numbers below 2^31 as doubles. The processor has an instruction for signed numbers only.
inline Double2 two_doubles(std::uint32_t first, std::uint32_t second) {
  return Double2{static_cast<double>(static_cast<std::int32_t>(first)),
                 static_cast<double>(static_cast<std::int32_t>(second))};
}

/// Sets all members of a point. The coordinates and the intensity are rounded to float. `ring_and_time` has
/// the ring in its lower half and the time above it.
inline void set_point(SensorPoint& point, Double2 xy, Double2 z_and_intensity, std::uint64_t ring_and_time,
                      std::uint32_t reflectivity) {
  using Float2 = float __attribute__((vector_size(8)));
  static_assert(offsetof(SensorPoint, z) == 8 && offsetof(SensorPoint, ring) == 16 &&
                offsetof(SensorPoint, time_ns) == 20);
  auto* const to = reinterpret_cast<std::byte*>(&point);
  const Float2 first = __builtin_convertvector(xy, Float2);
  const Float2 second = __builtin_convertvector(z_and_intensity, Float2);
  std::memcpy(to, &first, 8);
  std::memcpy(to + 8, &second, 8);
  std::memcpy(to + 16, &ring_and_time, 8);
  point.reflectivity = reflectivity;
}

}  // namespace pcl_bv::detail
