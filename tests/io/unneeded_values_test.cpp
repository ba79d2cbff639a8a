// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What stands in fields that are no coordinates does not stop a cloud from being read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "files.h"
#include "pcl_bv/io/ply.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::detail {
namespace {

class UnneededValues : public FileTest {
 protected:
  /// A .pcd of x y z and one field more, of which these are the words.
  static std::string text(const std::string& type, int size, const std::vector<std::string>& words) {
    std::string all = "FIELDS x y z label\nSIZE 4 4 4 " + std::to_string(size) + "\nTYPE F F F " + type +
                      "\nWIDTH " + std::to_string(words.size()) + "\nHEIGHT 1\nDATA ascii\n";
    for (const std::string& word : words)
      all += "1 2 3 " + word + "\n";
    return all;
  }

  RawCloud read(const std::string& content, const ParallelPolicy& policy = Serial{}) const {
    write_text(file("a.pcd"), content);
    return read_pcd(file("a.pcd"), policy);
  }

  RawCloud read_ply_text(const std::string& type, const std::string& rows) const {
    write_text(file("a.ply"), "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty " + type +
                                  " label\nproperty float y\nproperty float z\nend_header\n" + rows);
    return read_ply(file("a.ply"));
  }
};

TEST_F(UnneededValues, ThatAreWholeNumbersAreIntegersHoweverTheyAreWritten) {
  const RawCloud cloud = read(text("I", 4, {"1.0", "-1.000000e+00", "2e3", "+7", "2147483647.0", "-0.0"}));
  EXPECT_EQ(integers_of(cloud, "label"), (std::vector<std::int64_t>{1, -1, 2000, 7, 2147483647, 0}));
  EXPECT_EQ(cloud.note, "");
  EXPECT_EQ(integers_of(read(text("U", 4, {"4.294967295e+09"})), "label")[0], 4294967295);
  EXPECT_EQ(integers_of(read_ply_text("uchar", "1 2.0 3 4\n1 200.000 3 4\n"), "label"),
            (std::vector<std::int64_t>{2, 200}));
}

TEST_F(UnneededValues, OfMinusOneAreTheGreatestOfUnsignedFields) {
  EXPECT_EQ(integers_of(read(text("U", 4, {"-1", "-1.0"})), "label"),
            (std::vector<std::int64_t>{4294967295, 4294967295}));
  EXPECT_EQ(integers_of(read(text("U", 1, {"-1", "-128"})), "label"), (std::vector<std::int64_t>{255, 128}));
  std::uint64_t label = 0;
  std::memcpy(&label, &read(text("U", 8, {"-1"})).data[12], 8);
  EXPECT_EQ(label, UINT64_MAX);
}

TEST_F(UnneededValues, ThatAreNoNumbersAreSaidAndReadAsNothing) {
  RawCloud cloud = read(text("U", 1, {"4", "256", "-129", "1.5"}));
  EXPECT_EQ(cloud.size(), 4U);
  EXPECT_EQ(
      cloud.note,
      "row 2, field 'label': '256' is not an unsigned integer of 1 byte; 3 such values are replaced by 0");
  EXPECT_EQ(cloud.data[12], std::byte{4});
  EXPECT_EQ(cloud.data[13 + 12], std::byte{0});
  cloud = read(text("F", 4, {"none", "2"}));
  EXPECT_EQ(cloud.note, "row 1, field 'label': 'none' is not a number; 1 such value is replaced by NaN");
  float value = 0;
  std::memcpy(&value, &cloud.data[12], 4);
  EXPECT_TRUE(std::isnan(value));
  cloud = read_ply_text("int", "1 x 3 4\n1 9007199254740994 3 4\n");
  EXPECT_EQ(cloud.note,
            "vertex 0, field 'label': 'x' is not an integer of 4 bytes; 2 such values are replaced by 0");
  EXPECT_EQ(load_point(cloud.xyz(), 1).z, 4);
}

TEST_F(UnneededValues, ThatAreNoNumbersAreRefusedByWhoAsksForThem) {
  const RawCloud cloud = read(text("U", 4, {"4", "car"}));
  try {
    integers_of(cloud, "label");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("field 'label' has values that are no integers: "));
    EXPECT_THAT(error.what(), testing::HasSubstr("row 2, field 'label': 'car'"));
  }
}

TEST_F(UnneededValues, AreSaidTheSameForAnyNumberOfThreads) {
  std::vector<std::string> words(60'000, "5");
  for (std::size_t i = 777; i < words.size(); i += 3)
    words[i] = "w" + std::to_string(i);
  const std::string all = text("I", 2, words);
  const std::string expected =
      "row 778, field 'label': 'w777' is not an integer of 2 bytes; 19741 such values are replaced by 0";
  for (const unsigned threads : {1U, 2U, 5U})
    EXPECT_EQ(read(all, Threads{threads}).note, expected) << threads;
}

TEST_F(UnneededValues, ThatAreMissingMakeTheRowTooShort) {
  EXPECT_EQ(reason_for_content(text("U", 4, {"", "2"})), "truncated: row 1 has 3 values instead of 4");
  EXPECT_EQ(reason_for_content(text("U", 4, {"x y", "2"})), "row 1 has more than 4 values");
}

TEST_F(UnneededValues, OfTypesNobodyKnowsMayFollowTheVertices) {
  write_text(file("a.ply"),
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 1\nproperty list vlong vlong vertex_index\nend_header\n1 2 3\n9 9 9\n");
  EXPECT_EQ(read_ply(file("a.ply")).size(), 1U);
}

}  // namespace
}  // namespace pcl_bv::detail
