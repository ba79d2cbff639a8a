// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers as text: rounding, what is beyond the range, and rows that do not fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "files.h"
#include "german_locale.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

const float infinity = std::numeric_limits<float>::infinity();

class PcdAscii : public FileTest {
 protected:
  // A file of x y z and one field more.
  static std::string text(const std::string& type, int size, int points, const std::string& rows) {
    return "VERSION 0.7\nFIELDS x y z a\nSIZE 4 4 4 " + std::to_string(size) + "\nTYPE F F F " + type +
           "\nWIDTH " + std::to_string(points) + "\nHEIGHT 1\nDATA ascii\n" + rows;
  }

  RawCloud read(const std::string& content) const {
    write_text(file("a.pcd"), content);
    return read_pcd(file("a.pcd"));
  }

  float read_float(const std::string& number) const {
    return float_at(read(text("F", 4, 1, "1 2 3 " + number + "\n")), "a", 0);
  }

  template <typename T>
  T read_as(const std::string& type, const std::string& number) const {
    const RawCloud cloud = read(text(type, sizeof(T), 1, "1 2 3 " + number + "\n"));
    T value;
    std::memcpy(&value, &cloud.data[12], sizeof value);
    return value;
  }

  // For a coordinate z of this type.
  std::string reason(const std::string& type, int size, const std::string& number) const {
    return reason_for_content("FIELDS x y z\nSIZE 4 4 " + std::to_string(size) + "\nTYPE F F " + type +
                              "\nWIDTH 1\nDATA ascii\n1 2 " + number + "\n");
  }
};

TEST_F(PcdAscii, ReadsFloatsToTheNearest) {
  EXPECT_EQ(read_float("1.5"), 1.5f);
  EXPECT_EQ(read_float("+1.5"), 1.5f);
  EXPECT_EQ(read_float("-.5"), -0.5f);
  EXPECT_EQ(read_float("1."), 1.0f);
  EXPECT_EQ(read_float("1E3"), 1000.0f);
  EXPECT_EQ(read_float("4.2108e+06"), 4.2108e+06f);
  EXPECT_EQ(read_float("16777217"), 16777216.0f);
  EXPECT_EQ(read_float("16777217.000001"), 16777218.0f);
  EXPECT_EQ(read_float("0.1000000014901161193847656250000000000000001"), 0.1f);
}

TEST_F(PcdAscii, KeepsTheSignOfZero) {
  EXPECT_TRUE(std::signbit(read_float("-0")));
  EXPECT_FALSE(std::signbit(read_float("0")));
  EXPECT_TRUE(std::signbit(read_float("-1e-60")));
}

TEST_F(PcdAscii, RoundsTinyNumbersToDenormalsOrZero) {
  const float least = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(read_float("1e-40"), 1e-40f);
  EXPECT_EQ(read_float("1.4e-45"), least);
  EXPECT_EQ(read_float("7.1e-46"), least) << "just over half of the least denormal";
  EXPECT_EQ(read_float("7.0e-46"), 0.0f) << "just under half of it";
  EXPECT_EQ(read_float("1e-46"), 0.0f);
  EXPECT_EQ(read_float("1e-400"), 0.0f);
  EXPECT_EQ(read_float("0.0000001e-45"), 0.0f);
  EXPECT_EQ(read_float("1000000e-400"), 0.0f);
  EXPECT_EQ(read_float("1e-99999999999999999999"), 0.0f);
  EXPECT_EQ(read_float("0." + std::string(500, '0') + "1"), 0.0f);
}

TEST_F(PcdAscii, RoundsHugeNumbersToTheGreatestOrInfinity) {
  EXPECT_EQ(read_float("3.4028235e38"), std::numeric_limits<float>::max());
  EXPECT_EQ(read_float("3.40282356e38"), std::numeric_limits<float>::max())
      << "less than half a step over it";
  EXPECT_EQ(read_float("3.4028236e38"), infinity) << "more than half a step over it";
  EXPECT_EQ(read_float("1e39"), infinity);
  EXPECT_EQ(read_float("-1e39"), -infinity);
  EXPECT_EQ(read_float("+1e400"), infinity);
  EXPECT_EQ(read_float("0.0001e99"), infinity);
  EXPECT_EQ(read_float("1e99999999999999999999"), infinity);
  EXPECT_EQ(read_float("1" + std::string(500, '0')), infinity);
  EXPECT_EQ(read_float("1" + std::string(500, '0') + "e-400"), infinity);
}

TEST_F(PcdAscii, ReadsNanAndInfInAnyCase) {
  for (const char* word : {"nan", "NaN", "-nan", "NAN", "+nan", "-nan(ind)"})
    EXPECT_TRUE(std::isnan(read_float(word)));
  for (const char* word : {"inf", "Inf", "INF", "+inf", "infinity"})
    EXPECT_EQ(read_float(word), infinity);
  EXPECT_EQ(read_float("-inf"), -infinity);
}

TEST_F(PcdAscii, ReadsDoubles) {
  EXPECT_EQ(read_as<double>("F", "0.1"), 0.1);
  EXPECT_EQ(read_as<double>("F", "1e39"), 1e39);
  EXPECT_EQ(read_as<double>("F", "4.9e-324"), 4.9e-324);
  EXPECT_EQ(read_as<double>("F", "1e-325"), 0.0);
  EXPECT_EQ(read_as<double>("F", "-1e309"), -std::numeric_limits<double>::infinity());
}

TEST_F(PcdAscii, ReadsIntegersUpToTheEndsOfTheirRange) {
  EXPECT_EQ(read_as<std::int8_t>("I", "-128"), -128);
  EXPECT_EQ(read_as<std::uint8_t>("U", "+255"), 255);
  EXPECT_EQ(read_as<std::int16_t>("I", "-32768"), -32768);
  EXPECT_EQ(read_as<std::uint16_t>("U", "65535"), 65535);
  EXPECT_EQ(read_as<std::int32_t>("I", "-2147483648"), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(read_as<std::uint32_t>("U", "4294967295"), 4294967295u);
  EXPECT_EQ(read_as<std::int64_t>("I", "-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(read_as<std::uint64_t>("U", "18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
}

TEST_F(PcdAscii, RefusesIntegersBeyondTheirRange) {
  EXPECT_EQ(reason("U", 1, "256"), "row 1, field 'z': '256' is not a number of TYPE U, SIZE 1");
  EXPECT_THAT(reason("I", 1, "128"), HasSubstr("'128' is not a number of TYPE I, SIZE 1"));
  EXPECT_THAT(reason("U", 2, "-32769"), HasSubstr("'-32769' is not a number"));
  EXPECT_THAT(reason("U", 4, "4294967296"), HasSubstr("'4294967296' is not a number"));
  EXPECT_THAT(reason("I", 8, "9223372036854775808"), HasSubstr("is not a number"));
  EXPECT_THAT(reason("U", 4, "nan"), HasSubstr("'nan' is not a number"));
  EXPECT_THAT(reason("U", 4, "1.5"), HasSubstr("'1.5' is not a number"));
}

TEST_F(PcdAscii, RefusesWordsThatAreNoNumbers) {
  for (const char* word :
       {"abc", "1.5x", "0x10", "1,5", "1e", "--1", "+-1", "++1", "+", "-", ".", "#", "1e+"}) {
    SCOPED_TRACE(word);
    EXPECT_EQ(reason("F", 4, word),
              "row 1, field 'z': '" + std::string(word) + "' is not a number of TYPE F, SIZE 4");
  }
}

TEST_F(PcdAscii, NamesTheRowThatIsTooShort) {
  EXPECT_EQ(reason_for_content(text("F", 4, 2, "1 2 3 4\n10 20 30\n")),
            "truncated: row 2 has 3 values instead of 4");
  EXPECT_EQ(reason_for_content(text("F", 4, 2, "1 2 3\n10 20 30 40\n")),
            "truncated: row 1 has 3 values instead of 4");
}

TEST_F(PcdAscii, NamesTheRowThatIsMissing) {
  EXPECT_EQ(reason_for_content(text("F", 4, 3, "10 20 30 40\n10 20 30 40\n\n \n")),
            "truncated: row 3 is missing, of 3");
}

TEST_F(PcdAscii, NamesTheRowThatIsTooLong) {
  EXPECT_EQ(reason_for_content(text("F", 4, 2, "1 2 3 4\n1 2 3 4 5\n")), "row 2 has more than 4 values");
}

TEST_F(PcdAscii, RefusesMoreRowsThanPoints) {
  EXPECT_EQ(reason_for_content(text("F", 4, 1, "1 2 3 4\n5 6 7 8\n")), "more rows than the 1 POINTS");
  EXPECT_EQ(reason_for_content(text("F", 4, 0, "1 2 3 4\n")), "more rows than the 0 POINTS");
}

TEST_F(PcdAscii, ReadsAnySpacing) {
  const RawCloud cloud = read(text("F", 4, 3, "\n\n  1\t2   3 4 \r\n\r\n5 6 7 8\n \n9 10 11 12"));
  EXPECT_EQ(cloud.size(), 3u);
  EXPECT_EQ(float_at(cloud, "a", 0), 4.0f);
  EXPECT_EQ(float_at(cloud, "a", 1), 8.0f);
  EXPECT_EQ(float_at(cloud, "a", 2), 12.0f);
}

TEST_F(PcdAscii, ReadsTheShortestPossibleRows) {
  const RawCloud cloud = read(text("U", 1, 2, "1 2 3 4\n5 6 7 8"));
  EXPECT_EQ(float_at(cloud, "z", 1), 7.0f);
}

TEST_F(PcdAscii, RefusesHalfFloats) {
  for (const int size : {1, 2})
    EXPECT_THAT(reason_for_content(text("F", size, 1, "1 2 3 4\n")),
                HasSubstr("TYPE F, SIZE " + std::to_string(size) + " is not supported in ascii"));
}

TEST_F(PcdAscii, DoesNotFollowTheLocale) {
  const test::GermanLocale german;
  EXPECT_EQ(read_float("1.250"), 1.25f);
  EXPECT_EQ(read_float("1.5e-60"), 0.0f);
  if (!german.is_set()) GTEST_SKIP() << "localedef cannot create a German locale";
}

}  // namespace
}  // namespace pcl_bv::detail
