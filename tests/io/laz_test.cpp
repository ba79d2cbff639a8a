// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Compressed points are those of the same file without compression, to the bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "files.h"
#include "las_bytes.h"
#include "laz_files.h"
#include "laz_table.h"
#include "pcl_bv/io/las.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Where parts of a compressed file begin.
class LazPlaces {
 public:
  explicit LazPlaces(const std::string& file) : file_(file) {}

  std::size_t record() const { return file_.find("laszip encoded") + 52; }
  std::size_t data() const { return value<std::uint32_t>(96); }
  std::size_t table() const { return static_cast<std::size_t>(value<std::int64_t>(data())); }

 private:
  template <typename T>
  T value(std::size_t at) const {
    T value;
    std::memcpy(&value, file_.data() + at, sizeof value);
    return value;
  }

  const std::string& file_;
};

class Laz : public FileTest {
 protected:
  // Writes a.las and a.laz.
  std::string compressed(const std::string& las, std::uint32_t chunk_points = 50'000) const {
    write_text(file("a.las"), las);
    compress_las(file("a.las"), file("a.laz"), chunk_points);
    return file_content(file("a.laz"));
  }

  std::string reason(const std::string& laz) const { return reason_for_content(laz, ".laz"); }
};

// The bits that fields are made of, of any value.
std::string with_random_points(const LasFile& las, unsigned seed) {
  std::string bytes = las.bytes();
  std::mt19937 random(seed);
  for (std::size_t i = las.first_record(); i < bytes.size(); ++i)
    bytes[i] = static_cast<char>(random());
  return bytes;
}

void expect_same(const RawCloud& a, const RawCloud& b, const std::string& where) {
  ASSERT_EQ(a.size(), b.size()) << where;
  ASSERT_EQ(a.fields.size(), b.fields.size()) << where;
  for (std::size_t i = 0; i < a.fields.size(); ++i)
    EXPECT_EQ(a.fields[i].name, b.fields[i].name) << where;
  EXPECT_TRUE(a.data == b.data) << where;
}

TEST_F(Laz, OfEachVersionAndFormatHasTheBitsOfTheLasFile) {
  for (const int minor : {2, 3, 4}) {
    for (int format = 0; format <= (minor < 3 ? 3 : minor == 3 ? 5 : 10); ++format) {
      for (const std::size_t extra : {0U, 5U}) {
        const std::string where = "1." + std::to_string(minor) + ", format " + std::to_string(format) + ", " +
                                  std::to_string(extra) + " extra bytes";
        const LasFile las{minor, format, kRecords[format] + extra, 3001};
        for (const std::string& bytes : {las.bytes(), with_random_points(las, 1)}) {
          const std::string laz = compressed(bytes, 1000);
          ASSERT_GE(static_cast<std::uint8_t>(laz[104]), 128) << where;
          const RawCloud cloud = read_cloud(file("a.laz"));
          expect_same(cloud, read_cloud(file("a.las")), where);
          EXPECT_EQ(cloud.note, "") << where;
          expect_same(read_cloud(file("a.laz"), {}, Threads{3}), cloud, where);
        }
      }
    }
  }
}

TEST_F(Laz, OfAnyChunkSizeIsReadCompletely) {
  for (const std::size_t points : {1U, 2U, 999U, 1000U, 1001U, 2000U}) {
    for (const std::uint32_t chunk : {1U, 7U, 1000U, 50'000U}) {
      for (const int format : {1, 7}) {
        const std::string where = std::to_string(points) + " points by " + std::to_string(chunk) +
                                  ", format " + std::to_string(format);
        compressed(LasFile{4, format, kRecords[format], points}.bytes(), chunk);
        expect_same(read_cloud(file("a.laz"), {}, Threads{2}), read_cloud(file("a.las")), where);
      }
    }
  }
}

TEST_F(Laz, HeaderIsThatOfTheLasFile) {
  compressed(LasFile{4, 7, 36, 100}.bytes());
  const CloudHeader header = read_cloud_header(file("a.laz"));
  EXPECT_EQ(header.cloud.size(), 100U);
  EXPECT_EQ(header.scalar, ScalarType::float64);
  EXPECT_FALSE(header.random_access);
}

TEST_F(Laz, OfNoPointsIsAnEmptyCloud) {
  for (const int format : {0, 6}) {
    compressed(LasFile{4, format, kRecords[format], 0}.bytes());
    EXPECT_EQ(read_cloud(file("a.laz")).size(), 0U);
  }
}

// COPC files have such chunks, one for each node of their tree.
TEST_F(Laz, OfChunksOfDifferentSizesIsReadInTheirOrder) {
  for (const int format : {3, 7}) {
    const LasFile whole{4, format, kRecords[format], 1234};
    const std::string las = whole.bytes();
    std::string laz, chunks;
    std::vector<LazTableEntry> entries;
    std::size_t done = 0;
    for (const std::size_t points : {1U, 1000U, 230U, 3U}) {
      LasFile part = whole;
      part.points = points;
      std::string bytes = part.bytes();
      bytes.replace(part.first_record(), std::string::npos, las, whole.first_record() + done * whole.record,
                    points * whole.record);
      done += points;
      laz = compressed(bytes);
      const LazPlaces places(laz);
      const std::size_t begin = places.data() + 8;
      chunks += laz.substr(begin, places.table() - begin);
      entries.push_back(
          {static_cast<std::uint32_t>(points), static_cast<std::uint32_t>(places.table() - begin)});
    }
    // The header of the last part, for all points.
    const LazPlaces last(laz);
    laz.resize(last.data() + 8);
    LasFile::put<std::uint32_t>(laz, last.record() + 12, 0xFFFFFFFF);
    LasFile::put<std::uint32_t>(laz, 107, format < 6 ? 1234 : 0);
    LasFile::put<std::uint64_t>(laz, 247, 1234);
    LasFile::put<std::int64_t>(laz, last.data(), static_cast<std::int64_t>(laz.size() + chunks.size()));
    laz += chunks + laz_table(entries, true);
    write_text(file("b.laz"), laz);
    write_text(file("b.las"), las);
    const RawCloud cloud = read_cloud(file("b.laz"), {}, Threads{2});
    expect_same(cloud, read_cloud(file("b.las")), std::to_string(format));
    EXPECT_EQ(cloud.note, "");
  }
}

// Returns the file with a table of chunks of its own.
std::string with_table(std::string laz, const std::vector<LazTableEntry>& entries) {
  const LazPlaces places(laz);
  const std::size_t table = places.table();
  LasFile::put<std::uint32_t>(laz, places.record() + 12, 0xFFFFFFFF);
  return laz.substr(0, table) + laz_table(entries, true);
}

TEST_F(Laz, ChunksWithoutPointsAreLeftOut) {
  const std::string whole = compressed(LasFile{4, 7, 36, 100}.bytes());
  const RawCloud las = read_cloud(file("a.las"));
  const LazPlaces places(whole);
  const auto bytes = static_cast<std::uint32_t>(places.table() - places.data() - 8);
  for (const auto& entries : std::vector<std::vector<LazTableEntry>>{
           {{0, 0}, {100, bytes}}, {{100, bytes}, {0, 0}}, {{0, 0}, {0, 0}, {100, bytes}, {0, 0}}}) {
    write_text(file("b.laz"), with_table(whole, entries));
    const RawCloud cloud = read_cloud(file("b.laz"));
    expect_same(cloud, las, "");
    EXPECT_EQ(cloud.note, "");
  }
  EXPECT_EQ(reason(with_table(whole, {{100, 35}})), "corrupt: chunk 0 has 35 bytes, a point has 36");
  EXPECT_EQ(reason(with_table(whole, {{100, bytes + 1}})),
            "corrupt: chunk 0 of " + std::to_string(bytes + 1) + " bytes ends behind the table of chunks");
}

// Many points in few bytes are no reason to refuse a file.
TEST_F(Laz, OfEqualPointsIsReadCompletely) {
  for (const int format : {0, 6}) {
    const LasFile las{4, format, kRecords[format], 600'000};
    std::string bytes = las.bytes();
    std::memset(bytes.data() + las.first_record(), 0, bytes.size() - las.first_record());
    const std::string laz = compressed(bytes);
    RecordProperty("bytes" + std::to_string(format), static_cast<int>(laz.size()));
    expect_same(read_cloud(file("a.laz"), {}, Threads{2}), read_cloud(file("a.las")), std::to_string(format));
  }
}

TEST_F(Laz, CutAnywhereIsRefused) {
  for (const int format : {3, 7}) {
    const std::string whole = compressed(LasFile{4, format, kRecords[format], 300}.bytes(), 100);
    for (std::size_t size = 0; size < whole.size(); ++size)
      ASSERT_NE(reason(whole.substr(0, size)), "") << size << " of " << whole.size();
    EXPECT_EQ(reason(whole), "");
  }
}

// The fuzzer tries more. No check can find all damage, because LAZ has no checksums.
TEST_F(Laz, DamagedAnywhereIsACloudOrOneLineOfReason) {
  for (const int format : {3, 10}) {
    const std::string whole = compressed(LasFile{4, format, kRecords[format] + 2, 300}.bytes(), 100);
    std::mt19937 random(7);
    for (int i = 0; i < 800; ++i) {
      std::string bytes = whole;
      const std::size_t at = random() % bytes.size();
      bytes[at] = static_cast<char>(random());
      const std::string why = reason(bytes);
      ASSERT_EQ(why.find('\n'), std::string::npos) << "byte " << at << ": " << why;
    }
  }
}

class DamagedLaz : public Laz {
 protected:
  // The file with a value at a byte.
  template <typename T>
  std::string reason_with(std::size_t at, T value) const {
    std::string bytes = whole_;
    LasFile::put(bytes, at, value);
    return reason(bytes);
  }

  std::size_t record() const { return LazPlaces(whole_).record(); }
  std::size_t data() const { return LazPlaces(whole_).data(); }
  std::size_t table() const { return LazPlaces(whole_).table(); }

  std::string whole_ = compressed(LasFile{4, 7, 36, 300}.bytes(), 100);
};

TEST_F(DamagedLaz, IsRefusedWithTheReason) {
  EXPECT_EQ(reason(whole_), "");
  EXPECT_THAT(reason_with(record() - 52, 'x'), HasSubstr("the record of LASzip is missing"));
  EXPECT_THAT(reason_with(record(), std::uint16_t{2}), HasSubstr("compressor 2 with coder 0 is not one of"));
  EXPECT_THAT(reason_with(record() + 34, std::uint16_t{6}), HasSubstr("item 0 of LASzip (type 6, 30 bytes"));
  EXPECT_THAT(reason_with(record() + 36, std::uint16_t{29}),
              HasSubstr("does not belong to the point format"));
  EXPECT_THAT(reason_with(record() + 32, std::uint16_t{1}), HasSubstr("does not have the items"));
  EXPECT_THAT(reason_with(data(), std::int64_t{1} << 40),
              StartsWith("truncated: the table of chunks would be"));
  EXPECT_THAT(reason_with(data(), static_cast<std::int64_t>(data())),
              HasSubstr("was not written completely"));
  EXPECT_THAT(reason_with(table(), 1), HasSubstr("unknown version 1"));
  EXPECT_THAT(reason_with(table() + 4, 0xFFFFFFFFU), HasSubstr("4294967295 chunks cannot be in"));
  EXPECT_EQ(reason_with(table() + 4, 2U), "truncated: the chunks have 200 points, the header says 300");
}

TEST_F(DamagedLaz, CannotAskForMuchMemory) {
  EXPECT_THAT(reason_with(247, std::uint64_t{1} << 40U), HasSubstr("cannot have 1099511627776 points"));
  const std::size_t layers = data() + 8 + 36;
  EXPECT_THAT(reason_with(layers + 4, 0xFFFFFFF0U), HasSubstr("does not have the bytes of its layers"));
  whole_ = compressed(LasFile{4, 7, 36 + 4096, 3}.bytes());
  EXPECT_EQ(reason(whole_), "");
  whole_ = compressed(LasFile{4, 7, 36 + 4097, 3}.bytes());
  EXPECT_EQ(reason(whole_),
            "header: 4097 extra bytes per point, at most 4096 are read from compressed files");
}

TEST_F(DamagedLaz, ChunkOfOtherThanItsPointsIsRefused) {
  const std::size_t first = data() + 8 + 36;
  const std::string chunk = "corrupt: the chunk at byte " + std::to_string(data() + 8) + " has ";
  EXPECT_EQ(reason_with(first, 0U), chunk + "0 points, the table of chunks says 100");
  EXPECT_EQ(reason_with(first, 101U), chunk + "101 points, the table of chunks says 100");
}

// A recorder that stopped early leaves such a header.
TEST_F(DamagedLaz, OfNoPointsWithChunksIsRefusedLikeLas) {
  EXPECT_EQ(reason_with(247, std::uint64_t{0}), "header: 0 points, but 3 chunks of points follow");
  whole_ = compressed(LasFile{2, 1, 28, 300}.bytes(), 100);
  EXPECT_EQ(reason_with(107, 0U), "header: 0 points, but 3 chunks of points follow");
}

// LASzip 3.5 would read outside of its tables.
TEST_F(DamagedLaz, BeginningOutsideOfTheCodersIntervalIsRefused) {
  const std::size_t first_layer = data() + 8 + 36 + 4 * 11;
  EXPECT_THAT(reason_with(first_layer, 0xFFFFFFFFU), HasSubstr("begins with no coded number"));
  whole_ = compressed(LasFile{2, 3, 34, 300}.bytes());
  EXPECT_THAT(reason_with(data() + 8 + 34, 0xFFFFFFFFU), HasSubstr("begins with no coded number"));
}

TEST_F(DamagedLaz, OfFewerPointsThanItsChunksHasANote) {
  std::string bytes = whole_;
  LasFile::put<std::uint64_t>(bytes, 247, 150);
  write_text(file("b.laz"), bytes);
  const RawCloud cloud = read_cloud(file("b.laz"));
  EXPECT_EQ(cloud.size(), 150U);
  EXPECT_EQ(cloud.note, "the header says 150 points; 1 more chunks of points follow, which are not read");
}

}  // namespace
}  // namespace pcl_bv::detail
