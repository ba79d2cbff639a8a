// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "block_index.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <random>
#include <vector>

namespace pcl_bv::detail {
namespace {

TEST(BlockIndex, NumbersKeysInTheOrderInWhichTheyFirstOccur) {
  std::mt19937_64 random(1);
  BlockIndex<std::uint64_t> index;
  for (const std::size_t points : {0, 1000, 100'000, 10}) {
    index.reset(points);
    std::map<std::uint64_t, std::uint32_t> expected;
    for (std::size_t i = 0; i < points; ++i) {
      const std::uint64_t key = i % 3 == 0 ? random() : random() % 1000 << 40U;
      const std::uint32_t next = static_cast<std::uint32_t>(expected.size());
      ASSERT_EQ(index.number(key), expected.emplace(key, next).first->second) << "seed 1, " << i;
    }
    for (const auto& [key, number] : expected)
      ASSERT_EQ(index.find_number(key), number);
    for (int i = 0; i < 1000; ++i)
      ASSERT_EQ(index.find_number(random()), std::nullopt);
  }
}

// Half of the slots are taken, all of them even. The search for another key goes on to an odd one.
TEST(BlockIndex, FindsNoNumberOfANewKeyIfEverySecondSlotIsTaken) {
  const auto begins_at_an_even_slot = [](std::uint64_t key) {
    return (key * 0x9e3779b97f4a7c15U >> 58U) % 2 == 0;  // of the 64 slots for few points
  };
  BlockIndex<std::uint64_t> index;
  index.reset(1);
  std::uint64_t key = 0;
  for (std::uint32_t taken = 0; taken < 32; ++key) {
    if (!begins_at_an_even_slot(key)) continue;
    EXPECT_EQ(index.number(key), taken);
    ++taken;
  }
  for (; key < 1000; ++key)
    EXPECT_EQ(index.find_number(key), std::nullopt);
}

}  // namespace
}  // namespace pcl_bv::detail
