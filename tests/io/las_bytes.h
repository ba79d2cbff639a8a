// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace pcl_bv {

/// A file written by the tables of the specification (LAS 1.4 R15).
struct LasFile {
  int minor = 2;
  int format = 0;
  std::size_t record = 20;
  std::size_t points = 3;
  double scale = 0.001;
  std::array<double, 3> offset{500'000, 5'400'000, 100};

  template <typename T>
  static void put(std::string& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
  }

  static std::int32_t stored(std::size_t i, std::size_t axis) {
    return static_cast<std::int32_t>(1'000'003 * (i + 1) * (axis + 1)) * (i % 2 == 0 ? 1 : -1);
  }

  std::string bytes() const {
    const std::size_t header = minor == 5 ? 393 : minor == 4 ? 375 : minor == 3 ? 235 : 227;
    std::string all(header + 54 + points * record, '\0');
    std::memcpy(all.data(), "LASF", 4);
    put<std::uint8_t>(all, 24, 1);
    put<std::uint8_t>(all, 25, static_cast<std::uint8_t>(minor));
    put<std::uint16_t>(all, 94, static_cast<std::uint16_t>(header));
    put<std::uint32_t>(all, 96, static_cast<std::uint32_t>(header + 54));
    put<std::uint32_t>(all, 100, 1);
    put<std::uint8_t>(all, 104, static_cast<std::uint8_t>(format));
    put<std::uint16_t>(all, 105, static_cast<std::uint16_t>(record));
    if (format < 6) put<std::uint32_t>(all, 107, static_cast<std::uint32_t>(points));
    if (minor >= 4) put<std::uint64_t>(all, 247, points);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      put(all, 131 + 8 * axis, scale);
      put(all, 155 + 8 * axis, offset[axis]);
    }
    for (std::size_t i = 0; i < points; ++i) {
      const std::size_t at = header + 54 + i * record;
      for (std::size_t axis = 0; axis < 3; ++axis)
        put(all, at + 4 * axis, stored(i, axis));
      put<std::uint16_t>(all, at + 12, static_cast<std::uint16_t>(1000 + i));
      put<std::uint8_t>(all, at + 14, static_cast<std::uint8_t>(i));  // packed bits: any byte
      put<std::uint8_t>(all, at + 15, static_cast<std::uint8_t>(i / 2));
      if (format >= 6) put<std::uint8_t>(all, at + 16, static_cast<std::uint8_t>(i / 3));
      if (format == 1 || (format >= 3 && format <= 5)) put(all, at + 20, 0.5 + static_cast<double>(i));
      if (format >= 6) put(all, at + 22, 0.5 + static_cast<double>(i));
      const std::size_t red[] = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
      if (red[format] != 0) put<std::uint16_t>(all, at + red[format], static_cast<std::uint16_t>(77 + i));
    }
    return all;
  }

  std::size_t first_record() const { return bytes().size() - points * record; }
};

inline constexpr std::size_t kRecords[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

}  // namespace pcl_bv
