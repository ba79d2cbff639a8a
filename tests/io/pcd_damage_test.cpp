// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files cut short, changed at random or made to ask for memory: always an error or a whole cloud.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <random>
#include <thread>

#include "allocations.h"
#include "files.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

const PcdEncoding encodings[] = {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed};

std::string header(const std::string& width, const std::string& encoding, const std::string& count = "1") {
  return "VERSION 0.7\nFIELDS x y z a\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 " + count + "\nWIDTH " +
         width + "\nHEIGHT 1\nDATA " + encoding + "\n";
}

std::string block_sizes(std::uint32_t packed, std::uint32_t unpacked) {
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &packed, 4);
  std::memcpy(bytes.data() + 4, &unpacked, 4);
  return bytes;
}

class PcdDamage : public FileTest {
 protected:
  std::string sample(const Layout& layout, PcdEncoding encoding) const {
    write_pcd(file("whole.pcd"), sample_cloud(layout, 3, 2, 21), encoding);
    return file_content(file("whole.pcd"));
  }

  // The number of points read, or -1 for an IoError with a reason in one printable line.
  long points_of(std::string_view content) const {
    write_text(file("damaged.pcd"), content);
    try {
      const RawCloud cloud = read_pcd(file("damaged.pcd"));
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

TEST_F(PcdDamage, CutAtAnyByteGivesAnErrorOrTheWholeCloud) {
  for (const Layout& layout : sample_layouts()) {
    for (const PcdEncoding encoding : encodings) {
      const std::string whole = sample(layout, encoding);
      ASSERT_EQ(points_of(whole), 6);
      for (std::size_t size = 0; size < whole.size(); ++size) {
        const long points = points_of(whole.substr(0, size));
        // Text may lose the last digits of its last number unnoticed; bytes may not.
        if (encoding == PcdEncoding::ascii) {
          ASSERT_TRUE(points == -1 || (points == 6 && size + 32 > whole.size()))
              << layout.name << " at " << size;
        } else {
          ASSERT_EQ(points, -1) << layout.name << " at " << size;
        }
      }
    }
  }
}

TEST_F(PcdDamage, RandomBytesNeverCrash) {
  for (const Layout& layout : sample_layouts()) {
    for (const PcdEncoding encoding : encodings) {
      const std::string whole = sample(layout, encoding);
      for (std::uint32_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(layout.name + ", encoding " + std::to_string(static_cast<int>(encoding)) + ", seed " +
                     std::to_string(seed));
        std::mt19937 random(seed);
        std::string damaged = whole;
        for (std::size_t n = 1 + random() % 4; n > 0; --n) {
          damaged[random() % damaged.size()] = static_cast<char>(random());
        }
        points_of(damaged);
        if (HasFailure()) return;
      }
    }
  }
}

TEST_F(PcdDamage, RandomDigitsInTheHeaderNeverCrashNorTakeMemory) {
  const char characters[] = "0123456789-. \nFIU";
  for (const PcdEncoding encoding : encodings) {
    const std::string whole = sample(sample_layouts()[8], encoding);
    const std::size_t begin = whole.find("SIZE");
    const std::size_t end = whole.find("DATA");
    largest_allocation = 0;
    for (std::uint32_t seed = 0; seed < 3000; ++seed) {
      SCOPED_TRACE("encoding " + std::to_string(static_cast<int>(encoding)) + ", seed " +
                   std::to_string(seed));
      std::mt19937 random(seed);
      std::string damaged = whole;
      for (std::size_t n = 1 + random() % 6; n > 0; --n) {
        damaged[begin + random() % (end - begin)] = characters[random() % (sizeof characters - 1)];
      }
      points_of(damaged);
      if (HasFailure()) return;
    }
    EXPECT_LT(largest_allocation, 200000u);
  }
}

TEST_F(PcdDamage, CutWhileItIsReadGivesAnErrorOrTheWholeCloud) {
  write_pcd(file("a.pcd"), sample_cloud(sample_layouts()[1], 20000, 1, 21));
  const auto size = std::filesystem::file_size(file("a.pcd"));
  std::atomic<bool> done{false};
  std::thread cutter([&] {
    for (std::uintmax_t i = 0; !done; ++i) {
      std::filesystem::resize_file(file("a.pcd"), size - i % 2 * (size / 2));
    }
  });
  for (int i = 0; i < 300; ++i) {
    const std::string reason = reason_for(file("a.pcd"));
    EXPECT_TRUE(reason.empty() || reason.starts_with("truncated: ") ||
                reason == "the file was changed while it was read")
        << reason;
  }
  done = true;
  cutter.join();
}

TEST_F(PcdDamage, BinaryBytesAfterThePointsAreIgnored) {
  EXPECT_EQ(points_of(sample(sample_layouts()[2], PcdEncoding::binary) + "more"), 6);
  EXPECT_EQ(points_of(sample(sample_layouts()[2], PcdEncoding::binary_compressed) + "more"), 6);
}

TEST_F(PcdDamage, BinaryWithTooFewBytesSaysHowMany) {
  EXPECT_EQ(reason_for_content(header("3", "binary") + std::string(38, 'b')),
            "truncated: 3 points of 13 bytes need 39 bytes, the file has 38");
}

TEST_F(PcdDamage, AsciiThatCannotHoldThePointsSaysSo) {
  EXPECT_EQ(reason_for_content(header("3", "ascii") + "1 2 3 4\n5 6 7 8\n1 2 3\n"),
            "truncated: 3 points of 4 values do not fit in the 22 bytes after the header");
}

TEST_F(PcdDamage, CompressedWithoutItsSizesSaysSo) {
  EXPECT_EQ(reason_for_content(header("3", "binary_compressed") + "1234567"),
            "truncated: the sizes of the compressed data are missing");
}

TEST_F(PcdDamage, CompressedBeyondTheEndOfTheFileSaysSo) {
  EXPECT_EQ(
      reason_for_content(header("3", "binary_compressed") + block_sizes(21, 39) + std::string(20, '\0')),
      "truncated: 21 bytes of compressed data, the file has 20");
}

TEST_F(PcdDamage, CompressedOfAnotherSizeThanThePointsSaysSo) {
  EXPECT_EQ(
      reason_for_content(header("3", "binary_compressed") + block_sizes(20, 40) + std::string(20, '\0')),
      "corrupt: compressed data of 40 bytes, the points of the header need 39");
}

TEST_F(PcdDamage, CompressedMoreThanLzfCanSaysSo) {
  const std::string content = header("100000000", "binary_compressed") + block_sizes(20, 1300000000);
  largest_allocation = 0;
  EXPECT_EQ(reason_for_content(content + std::string(20, '\0')),
            "corrupt: 20 bytes of compressed data cannot hold 1300000000");
  EXPECT_LT(largest_allocation, 200000u);
}

TEST_F(PcdDamage, CompressedOfNothingSaysSo) {
  EXPECT_THAT(reason_for_content(header("3", "binary_compressed") + block_sizes(0, 39)),
              HasSubstr("0 bytes of compressed data cannot hold 39"));
}

TEST_F(PcdDamage, CompressedThatCannotBeUnpackedSaysSo) {
  for (const char byte : {'\0', '\x05', '\x20', '\xe0', '\xff'}) {
    EXPECT_EQ(
        reason_for_content(header("3", "binary_compressed") + block_sizes(20, 39) + std::string(20, byte)),
        "corrupt: the compressed data cannot be unpacked");
  }
}

std::string two_points_of_five_fields() {
  return "FIELDS x y z a b\nSIZE 4 4 4 4 4\nTYPE F F F F F\nWIDTH 2\nDATA binary_compressed\n" +
         block_sizes(40, 40);
}

TEST_F(PcdDamage, CompressedThatIsStoredAsItIsIsRead) {
  const float columns[10] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const std::string stored(reinterpret_cast<const char*>(columns), sizeof columns);
  write_text(file("stored.pcd"), two_points_of_five_fields() + stored);
  const RawCloud cloud = read_pcd(file("stored.pcd"));
  EXPECT_EQ(float_at(cloud, "x", 1), 2.0F);
  EXPECT_EQ(float_at(cloud, "z", 0), 5.0F);
  EXPECT_EQ(float_at(cloud, "b", 1), 10.0F);
  EXPECT_EQ(reason_for_content(two_points_of_five_fields() + stored.substr(1)),
            "truncated: 40 bytes of compressed data, the file has 39");
}

TEST_F(PcdDamage, CompressedThatIsNoSmallerThanItsDataIsUnpackedAllTheSame) {
  const float columns[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::string data(reinterpret_cast<const char*>(columns), sizeof columns);
  // Runs of 32 and 4 bytes as they are, then the last 4 again: 33 + 5 + 2 bytes for 40.
  const std::string packed = '\x1f' + data.substr(0, 32) + '\x03' + data.substr(32) + "\x40\x03";
  ASSERT_EQ(packed.size(), 40U);
  write_text(file("packed.pcd"), two_points_of_five_fields() + packed);
  const RawCloud cloud = read_pcd(file("packed.pcd"));
  EXPECT_EQ(float_at(cloud, "x", 1), 2.0F);
  EXPECT_EQ(float_at(cloud, "b", 0), 9.0F);
  EXPECT_EQ(float_at(cloud, "b", 1), 9.0F);
}

TEST_F(PcdDamage, GreatSizesInASmallFileTakeNoMemory) {
  for (const char* encoding : {"ascii", "binary", "binary_compressed"}) {
    for (const char* width : {"100000000", "1000000000000", "300000000000000000"}) {
      for (const char* count : {"1", "4294967295"}) {
        largest_allocation = 0;
        EXPECT_NE(reason_for_content(header(width, encoding, count) + std::string(1000, '1')), "")
            << encoding << " " << width << " " << count;
        EXPECT_LT(largest_allocation, 200000u);
      }
    }
  }
}

TEST_F(PcdDamage, AGreatCountOfNoPointsTakesNoMemory) {
  for (const char* encoding : {"ascii", "binary", "binary_compressed"}) {
    largest_allocation = 0;
    EXPECT_EQ(points_of(header("0", encoding, "4294967295")), 0);
    EXPECT_LT(largest_allocation, 200000u);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
