// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/number_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <sstream>

#include "german_locale.h"

namespace pcl_bv::detail {
namespace {

std::string printed(const char* pattern, int precision, double value) {
  char text[400];
  std::snprintf(text, sizeof text, pattern, precision, value);
  return text;
}

TEST(NumberText, EqualsPrintfExceptForNegativeZero) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 100'000; ++i) {
    double value = std::bit_cast<double>(random());
    if (i % 2 == 0)
      value = std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -50 - i % 30);
    if (std::isnan(value)) continue;
    const int precision = i % 10;
    EXPECT_EQ(fixed_text(value, precision), printed("%.*f", precision, value)) << value;
    EXPECT_EQ(general_text(value, precision), printed("%.*g", precision, value)) << value;
  }
  EXPECT_EQ(fixed_text(-0.0, 1), "0.0");
  EXPECT_EQ(general_text(-0.0, 3), "0");
  const double largest = -std::numeric_limits<double>::max();
  EXPECT_EQ(fixed_text(largest, 40), printed("%.*f", 40, largest));
}

TEST(NumberText, HasADecimalPointInALocaleWithCommas) {
  const test::GermanLocale german;
  std::ostringstream stream;
  stream << 1250.5;
  ASSERT_EQ(stream.str(), "1.250,5");
  ASSERT_EQ(printed("%.*f", 1, 1250.5), german.is_set() ? "1250,5" : "1250.5");
  EXPECT_EQ(fixed_text(1250.5, 1), "1250.5");
  EXPECT_EQ(general_text(0.125, 2), "0.12");
  std::string_view text = " 1.250\t-0.5";
  double value = 0;
  EXPECT_TRUE(next_number(text, value));
  EXPECT_EQ(value, 1.25);
  EXPECT_TRUE(next_number(text, value));
  EXPECT_EQ(value, -0.5);
  EXPECT_FALSE(next_number(text, value));
  EXPECT_EQ(text, "");
}

TEST(NumberText, OfAnotherTextIsNotConsumed) {
  for (const std::string wrong : {"x", "+", "+-1", "-+1", ",1", "--1"}) {
    std::string_view text = wrong;
    double value = 0;
    EXPECT_FALSE(next_number(text, value)) << wrong;
    EXPECT_EQ(text, wrong);
  }
}

TEST(NumberText, MayHaveAPlusSignAndIsInfiniteBeyondTheRange) {
  std::string_view text = "+1.5x";
  double value = 0;
  EXPECT_TRUE(next_number(text, value));
  EXPECT_EQ(value, 1.5);
  EXPECT_EQ(text, "x");
  text = "1e999";
  EXPECT_TRUE(next_number(text, value));
  EXPECT_EQ(value, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace pcl_bv::detail
