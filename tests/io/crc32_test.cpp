// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "pcl_bv/io/crc32.h"

namespace pcl_bv {
namespace {

std::vector<std::byte> random_bytes(std::size_t size) {
  std::mt19937 random(2026);
  std::vector<std::byte> bytes(size);
  for (std::byte& byte : bytes)
    byte = static_cast<std::byte>(random());
  return bytes;
}

std::uint32_t crc_by_boost(const std::byte* data, std::size_t size) {
  boost::crc_32_type sum;
  sum.process_bytes(data, size);
  return sum.checksum();
}

// Around 1024 bytes, where vectors begin, and at each number of bytes that is left of their steps of 256.
TEST(Crc32, EqualsThatOfBoostForEverySize) {
  const std::vector<std::byte> bytes = random_bytes(9000);
  for (std::size_t size = 0; size < 2600; ++size) {
    const std::byte* const data = bytes.data() + size % 67;  // any alignment
    ASSERT_EQ(detail::crc32_of(data, size), crc_by_boost(data, size)) << size << " bytes, seed 2026";
  }
}

TEST(Crc32, ContinuesThatOfThePrecedingBytes) {
  const std::vector<std::byte> bytes = random_bytes(100'000);
  const std::uint32_t expected = crc_by_boost(bytes.data(), bytes.size());
  for (std::size_t first = 0; first < bytes.size(); first += 4999) {
    const std::uint32_t before = detail::crc32_of(bytes.data(), first);
    ASSERT_EQ(detail::crc32_of(bytes.data() + first, bytes.size() - first, before), expected) << first;
  }
}

TEST(Crc32, IsUnchangedByNoBytes) {
  EXPECT_EQ(detail::crc32_of(nullptr, 0, 0x1234), 0x1234U);
  EXPECT_EQ(detail::crc32_of(nullptr, 0), 0U);
}

TEST(Crc32, NoticesAChangedBitAnywhere) {
  std::vector<std::byte> bytes = random_bytes(4096);
  const std::uint32_t expected = detail::crc32_of(bytes.data(), bytes.size());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += 13) {
    bytes[bit / 8] ^= std::byte{1} << bit % 8;
    ASSERT_NE(detail::crc32_of(bytes.data(), bytes.size()), expected) << "bit " << bit;
    bytes[bit / 8] ^= std::byte{1} << bit % 8;
  }
}

}  // namespace
}  // namespace pcl_bv
