// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The quick way from text to a number gives what std::from_chars gives, to the bit, or nothing.
#include "short_decimal.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace pcl_bv::detail {
namespace {

template <typename T>
auto bits(T value) {
  return std::bit_cast<std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>(value);
}

// Whether the quick way took the number; if so it must be right.
template <typename T>
bool takes(std::string text) {
  const std::size_t size = text.size();
  text.append(kTextPadding, '\n');
  T quick;
  const char* after = read_short_decimal(text.data(), quick);
  if (!after) return false;
  T expected;
  const char* begin = text.data() + (text[0] == '+');
  const auto [end, error] = std::from_chars(begin, text.data() + size, expected);
  EXPECT_EQ(error, std::errc()) << text;
  EXPECT_EQ(after, end) << text;
  EXPECT_EQ(end, text.data() + size) << text;
  EXPECT_EQ(bits(quick), bits(expected)) << text;
  return true;
}

std::string random_decimal(std::mt19937& random) {
  std::string text = std::array{"", "-", "+"}[random() % 3];
  const auto digits = [&](std::size_t n) {
    for (; n > 0; --n)
      text += static_cast<char>('0' + (random() % 4 == 0 ? 0 : random() % 10));
  };
  digits(random() % 10);
  if (random() % 4 != 0) text += '.', digits(random() % 14);
  if (random() % 3 == 0) {
    text += std::array{"e", "E", "e-", "e+"}[random() % 4];
    digits(random() % 4);
  }
  return text;
}

TEST(ShortDecimal, RoundsAnyTextLikeFromCharsOrRefusesIt) {
  std::mt19937 random(1);
  long taken = 0;
  for (int i = 0; i < 1'000'000 && !HasFailure(); ++i) {
    const std::string text = random_decimal(random);
    taken += takes<float>(text);
    takes<double>(text);
  }
  EXPECT_GT(taken, 500'000);
}

// A float, the next one, and the middle between them, which has too many digits for most of them.
TEST(ShortDecimal, IsRightOnBothSidesOfTheMiddleBetweenFloats) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 300'000 && !HasFailure(); ++i) {
    const int exponent = static_cast<int>(random() % 40) - 8;
    const double below = std::ldexp(static_cast<double>((1U << 23) + random() % (1U << 23)), exponent - 23);
    const double middle = below + std::ldexp(0.5, exponent - 23);
    for (const int digits : {9, 12, 15, 17, 18}) {
      char text[64];
      std::snprintf(text, sizeof text, "%.*g", digits, middle);
      takes<float>(text);
      std::string next = text;
      const std::size_t last = next.find_last_of("0123456789", next.find('e') - 1);
      if (next[last] < '9') ++next[last];
      takes<float>(next);
    }
  }
}

TEST(ShortDecimal, LeavesExactMiddlesToOthers) {
  for (const char* text :
       {"16777217", "16777219", "33554434.0", "0.500000029802322388", "8388608.5", "8388609.5"})
    EXPECT_FALSE(takes<float>(text)) << text;
  for (const char* text : {"16777217.01", "16777216.99", "16777218", "8388608.50001"})
    EXPECT_TRUE(takes<float>(text)) << text;
}

TEST(ShortDecimal, TakesTheNumbersOfClouds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> metres(-200, 200);
  int taken = 0;
  for (int i = 0; i < 100'000; ++i) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", 3 + i % 7, metres(random) / (i % 3 == 0 ? 1000 : 1));
    taken += takes<float>(text);
  }
  EXPECT_EQ(taken, 100'000);
  for (const char* text : {"0", "-0", "0.0", "1", "-.5", "7.", "+2", "4321098.3", "1.5e-05", "5E3"}) {
    EXPECT_TRUE(takes<float>(text)) << text;
    EXPECT_TRUE(takes<double>(text)) << text;
  }
}

TEST(ShortDecimal, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "-", "+", ".", "-.", "e5", "1e", "1e+", "--1", "+-1", "1.5x", "1,5", "nan",
                           "inf", "0x10", "1..2", "1e5.", "1\x01"}) {
    EXPECT_FALSE(takes<float>(text)) << text;
    EXPECT_FALSE(takes<double>(text)) << text;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
