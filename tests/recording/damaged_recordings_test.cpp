// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Damaged and hostile recordings: what is intact is found, in a time and memory that the file's size bounds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "db3_pages.h"
#include "made_mcap.h"
#include "made_packets.h"
#include "pcl_bv/io/raw_cloud.h"
#include "recording_files.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class DamagedRecording : public RecordingFiles {
 protected:
  std::string reason(const std::string& name) const {
    try {
      open_recording(at(name));
    } catch (const IoError& error) {
      return error.what();
    }
    return "none";
  }
  std::string with_folder(const std::string& names) const {
    std::filesystem::create_directories(at("bag"));
    put("bag/metadata.yaml", "rosbag2_bagfile_information: {relative_file_paths: [" + names + "]}\n");
    return reason("bag");
  }
};

// The entry made the walk stay where it was and take memory until there was none.
TEST_F(DamagedRecording, ASummaryWithAChunkOfNoBytesIsNotUsed) {
  for (const std::uint64_t bytes : {0U, 8U}) {
    McapBuilder made;
    put("a.mcap", made.chunk({1, 2}, true).index(8, bytes).closed(true, true, nullptr));
    const auto reader = open_recording(at("a.mcap"));
    EXPECT_EQ(times_of(*reader), (std::vector<std::int64_t>{1, 2}));
    EXPECT_THAT(reader->warning_lines(), ElementsAre(StartsWith("no usable index (")));
  }
}

// Else each entry of a small summary could make the whole file be read.
TEST_F(DamagedRecording, ASummaryWithOverlappingChunksIsNotUsed) {
  McapBuilder made;
  made.chunk({1, 2}, true).chunk({3}, false).index(8, 200);
  put("a.mcap", made.closed(true, true, nullptr));
  const auto reader = open_recording(at("a.mcap"));
  EXPECT_EQ(times_of(*reader), (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_THAT(reader->warning_lines(), ElementsAre(StartsWith("no usable index (two chunks overlap)")));
}

TEST_F(DamagedRecording, AChunkOfAnUnknownCompressionIsNamed) {
  McapBuilder made;
  made.chunk({1}, true).chunk({2}, false, "brotli").chunk({3}, false);
  put("a.mcap", made.without_summary());
  const auto reader = open_recording(at("a.mcap"));
  EXPECT_EQ(times_of(*reader), (std::vector<std::int64_t>{1, 3}));
  EXPECT_THAT(reader->warning_lines(), testing::Contains(HasSubstr("its compression is 'brotli'")));
}

// Of a later version of the format.
TEST_F(DamagedRecording, RecordsOfReservedOpcodesAreSkipped) {
  McapBuilder made;
  const std::string later = std::string("\x42\x05\0\0\0\0\0\0\0", 9) + "later";
  put("a.mcap", made.described().loose(1).junk(later).loose(2).without_summary());
  const auto reader = open_recording(at("a.mcap"));
  EXPECT_EQ(times_of(*reader), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(reader->warning_lines().size(), 1U);  // only that it has no index
}

TEST_F(DamagedRecording, WarningsAreLimitedAndDamageIsReadOnce) {
  McapBuilder made;
  made.described();
  for (std::uint64_t i = 0; i < 2000; ++i)
    made.junk("\x01\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x7F").chunk({i}, false);
  const std::string bytes = made.without_summary();
  put("a.mcap", bytes);
  const std::uint64_t before = bytes_read();
  const auto reader = open_recording(at("a.mcap"));
  EXPECT_EQ(times_of(*reader).size(), 2000U);
  EXPECT_LT(bytes_read() - before, 50 * bytes.size());
  ASSERT_EQ(reader->warning_lines().size(), 11U);
  EXPECT_THAT(reader->warning_lines()[1], testing::MatchesRegex("skipped damaged bytes [0-9]+ to [0-9]+"));
  EXPECT_EQ(reader->warning_lines()[10], "further warnings are not listed: 1991 so far");
}

// They opened the folder in itself until the stack ended.
TEST_F(DamagedRecording, MetadataThatNamesFoldersIsRefused) {
  for (const char* name : {"\".\"", "\"bag/\"", "\"..\"", "metadata.yaml"})
    EXPECT_THAT(with_folder(name), HasSubstr("no .db3 or .mcap file")) << name;
  std::filesystem::create_directories(at("bag/a.db3"));
  std::filesystem::create_symlink(at("bag"), at("bag/a.db3/b.db3"));
  put("bag/a.db3/metadata.yaml", "rosbag2_bagfile_information: {relative_file_paths: [b.db3]}\n");
  EXPECT_THAT(with_folder("a.db3"), HasSubstr("no .db3 or .mcap file"));
}

// Each of the bytes before a mark may be the length of a header: of 32 MiB here, which were read.
TEST_F(DamagedRecording, ABagsLongHeadersAreNotRead) {
  std::string bytes = "#ROSBAG V2.0\n";
  for (int mark = 0; mark < 4; ++mark) {
    for (int i = 0; i < 64; ++i)
      bytes += std::string("\0\0\0\2", 4);
    bytes += std::string("\4\0\0\0op=\5", 8);
  }
  bytes.resize(34U << 20U);
  put("a.bag", bytes);
  const std::uint64_t before = bytes_read();
  const auto reader = open_recording(at("a.bag"));
  EXPECT_TRUE(all_of(*reader).empty());
  EXPECT_LT(bytes_read() - before, 3 * bytes.size());
}

// SQLite's format: https://www.sqlite.org/fileformat2.html.
TEST_F(DamagedRecording, ARowThatIsNamedOftenIsTakenOnce) {
  std::string file = "SQLite format 3";
  file.resize(2 * 65'536);
  file[17] = 1;  // pages of 64 KiB
  const std::size_t page = 65'536, cells = 30'000;
  const std::string cell("\x08\x01\x05\x00\x01\x01\x0E\x01\x02x", 10);
  file[page] = '\x0D';
  file.replace(page + 3, 2, pcl_bv::bytes_of(cells, 2, true));
  for (std::size_t i = 0; i < cells; ++i)
    file.replace(page + 8 + 2 * i, 2, pcl_bv::bytes_of(page - cell.size(), 2, true));
  file.replace(2 * page - cell.size(), cell.size(), cell);
  put("a.db3", file);
  const Db3Pages pages(at("a.db3"));
  ASSERT_EQ(pages.messages().size(), 1U);
  EXPECT_EQ(pages.messages()[0].size, 1U);
  EXPECT_LT(pages.messages().capacity(), 10U);
}

TEST_F(DamagedRecording, ADatabaseThatIsNotDamagedIsNotCalledSo) {
  if (std::system("which sqlite3 > /dev/null") != 0) GTEST_SKIP() << "sqlite3 is not installed";
  put("make.sql",
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, stamp INTEGER, data BLOB);"
      "INSERT INTO topics VALUES(1,'/points','sensor_msgs/msg/PointCloud2','cdr');"
      "INSERT INTO messages VALUES(1,1,5,X'00010000');");
  ASSERT_EQ(std::system(("cd '" + at("").string() + "' && sqlite3 a.db3 < make.sql").c_str()), 0);
  EXPECT_EQ(reason("a.db3"), "the database lacks a table or a column of rosbag2");
}

}  // namespace
}  // namespace pcl_bv::detail
