// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// .ply files cut short, changed at random or made to ask for memory: always an error or a whole cloud.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

#include "allocations.h"
#include "files.h"
#include "pcl_bv/io/ply.h"
#include "sample_plys.h"

namespace pcl_bv::detail {
namespace {

class PlyDamage : public FileTest {
 protected:
  // The number of points read, or -1 for an IoError with a reason in one printable line.
  long points_of(std::string_view content) const {
    write_text(file("damaged.ply"), content);
    try {
      const RawCloud cloud = read_ply(file("damaged.ply"));
      EXPECT_EQ(cloud.data.size(), cloud.size() * cloud.point_step);
      EXPECT_EQ(cloud.xyz().count, cloud.size());
      return static_cast<long>(cloud.size());
    } catch (const IoError& error) {
      const std::string_view reason = error.what();
      EXPECT_TRUE(!reason.empty() && std::all_of(reason.begin(), reason.end(), [](char c) {
        return c >= ' ' && c <= '~';
      })) << reason;
      return -1;
    }
  }
};

const Layout& every_type() {
  return ply_layouts().back();
}

TEST_F(PlyDamage, CutAtAnyByteGivesAnErrorOrTheWholeCloud) {
  const RawCloud cloud = ply_cloud(every_type(), 4);
  for (PlyStyle style : ply_styles()) {
    if (style.elements_after) continue;
    SCOPED_TRACE(describe(every_type(), style));
    const std::string whole = ply_text(cloud, style);
    ASSERT_EQ(points_of(whole), 4);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const long points = points_of(whole.substr(0, size));
      // Text may lose the last digits of its last number unnoticed; bytes may not.
      const bool unnoticed = style.format == "ascii" && size + 32 > whole.size();
      ASSERT_TRUE(points == -1 || (points == 4 && unnoticed)) << size;
    }
  }
}

TEST_F(PlyDamage, RandomBytesNeverCrashNorTakeMemory) {
  const RawCloud cloud = ply_cloud(every_type(), 4);
  largest_allocation = 0;
  for (const PlyStyle& style : ply_styles()) {
    const std::string whole = ply_text(cloud, style);
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
      SCOPED_TRACE(describe(every_type(), style) + ", seed " + std::to_string(seed));
      std::mt19937 random(seed);
      std::string damaged = whole;
      for (std::size_t n = 1 + random() % 4; n > 0; --n)
        damaged[random() % damaged.size()] = static_cast<char>(random());
      points_of(damaged);
      if (HasFailure()) return;
    }
  }
  EXPECT_LT(largest_allocation, 200000u);
}

TEST_F(PlyDamage, RandomDigitsAndWordsInTheHeaderNeverCrashNorTakeMemory) {
  const RawCloud cloud = ply_cloud(every_type(), 4);
  const char* words[] = {"0",       "1",        "255",   "-1",  "4294967295", "18446744073709551615",
                         "list",    "float",    "uchar", "int", "face",       "vertex",
                         "element", "property", "x",     "\n"};
  largest_allocation = 0;
  for (const PlyStyle& style : ply_styles()) {
    if (style.newline != "\n") continue;
    const std::string whole = ply_text(cloud, style);
    const std::size_t end = whole.find("end_header");
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
      SCOPED_TRACE(describe(every_type(), style) + ", seed " + std::to_string(seed));
      std::mt19937 random(seed);
      std::string damaged = whole;
      for (std::size_t n = 1 + random() % 3; n > 0; --n) {
        const std::size_t word = damaged.find_first_of(" \n", 4 + random() % (end - 4)) + 1;
        const std::size_t length = std::min(damaged.find_first_of(" \n", word), damaged.size()) - word;
        damaged.replace(word, length, words[random() % std::size(words)]);
      }
      points_of(damaged);
      if (HasFailure()) return;
    }
  }
  EXPECT_LT(largest_allocation, 200000u);
}

TEST_F(PlyDamage, GreatSizesInASmallFileTakeNoMemory) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const char* count : {"100000000", "1000000000000", "1500000000000000000"}) {
      for (const char* list : {"", "property list uint double l\n"}) {
        largest_allocation = 0;
        const std::string header = "ply\nformat " + std::string(format) + " 1.0\nelement vertex " + count +
                                   "\nproperty float x\nproperty float y\nproperty float z\n" + list +
                                   "end_header\n";
        EXPECT_NE(reason_for_content(header + std::string(1000, '1'), ".ply"), "") << header;
        EXPECT_LT(largest_allocation, 200000u);
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
