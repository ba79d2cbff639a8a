// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/recording/mcap_writer.h"
#include "pcl_bv/recording/rosbag2_writer.h"
#include "recording_files.h"

namespace pcl_bv::detail {
namespace {

// Files as rosbag2 makes them, by the programs sqlite3 and zstd.
class Rosbag2 : public RecordingFiles {
 protected:
  void SetUp() override {
    RecordingFiles::SetUp();
    if (std::system("which sqlite3 zstd > /dev/null") != 0)
      GTEST_SKIP() << "sqlite3 or zstd is not installed";
  }

  void shell(const std::string& command) const {
    ASSERT_EQ(std::system(("cd '" + at("").string() + "' && " + command).c_str()), 0) << command;
  }

  // Two topics; times that go back now and then.
  std::vector<Sent> make(const std::string& name, std::size_t messages, std::int64_t begin) const {
    std::mt19937 random(static_cast<unsigned>(begin));
    std::string sql =
        "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);"
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT "
        "NULL, "
        "data BLOB NOT NULL);"
        "CREATE INDEX timestamp_idx ON messages (timestamp ASC);"
        "INSERT INTO topics VALUES(1,'/points','sensor_msgs/msg/PointCloud2','cdr','');"
        "INSERT INTO topics VALUES(4,'/it''s','std_msgs/msg/String','cdr','');";
    std::vector<Sent> sent;
    for (std::size_t i = 0; i < messages; ++i) {
      const std::int64_t time = begin + static_cast<std::int64_t>(10 * i + random() % 40);
      std::string data =
          std::string("\0\1\0\0", 4) + std::string(random() % 50, static_cast<char>('a' + i % 26));
      std::string hex;
      for (const char c : data) {
        char digits[3];
        std::snprintf(digits, sizeof digits, "%02X", static_cast<unsigned char>(c));
        hex += digits;
      }
      const bool points = random() % 2 == 0;
      sql += "INSERT INTO messages(topic_id,timestamp,data) VALUES(" + std::string(points ? "1" : "4") + "," +
             std::to_string(time) + ",X'" + hex + "');\n";
      sent.push_back({points ? "/points" : "/it's", time, time, data});
    }
    put("make.sql", sql);
    shell("rm -f " + name + " && sqlite3 " + name + " < make.sql");
    std::stable_sort(sent.begin(), sent.end(),
                     [](const Sent& a, const Sent& b) { return a.log_time < b.log_time; });
    return sent;
  }
};

TEST_F(Rosbag2, AFileGivesItsMessagesInTheOrderOfTheTimes) {
  std::vector<Sent> sent = make("a#%?.db3", 200, 1'700'000'000'000'000'000);
  const auto reader = open_recording(at("a#%?.db3"));
  EXPECT_EQ(all_of(*reader), sent);
  ASSERT_EQ(reader->topics().size(), 2U);
  EXPECT_EQ(reader->topics()[0].type, "sensor_msgs/msg/PointCloud2");
  EXPECT_EQ(reader->topics()[0].encoding, "cdr");
  EXPECT_EQ(reader->topics()[0].messages + reader->topics()[1].messages, 200U);
  reader->select({1});
  std::erase_if(sent, [](const Sent& one) { return one.topic == "/points"; });
  EXPECT_EQ(all_of(*reader), sent);
  reader->select({});
  EXPECT_TRUE(all_of(*reader).empty());
  EXPECT_THROW(reader->select({2}), std::out_of_range);
}

TEST_F(Rosbag2, AFolderIsOneRecordingWithAndWithoutItsMetadata) {
  shell("mkdir bag");
  std::vector<Sent> sent;
  for (int part : {0, 1, 2, 10}) {
    const std::vector<Sent> more =
        make("bag/bag_" + std::to_string(part) + ".db3", 30, 1'000'000 * (part + 1));
    sent.insert(sent.end(), more.begin(), more.end());
  }
  EXPECT_EQ(all_of(*open_recording(at("bag"))), sent);
  put("bag/metadata.yaml",
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n  relative_file_paths:\n"
      "    - bag_0.db3\n    - bag/bag_2.db3\n    - bag_10.db3\n");
  const auto reader = open_recording(at("bag"));
  sent.erase(sent.begin() + 30, sent.begin() + 60);
  EXPECT_EQ(all_of(*reader), sent);
  EXPECT_EQ(reader->topics().size(), 2U);
  reader->select({0});
  std::erase_if(sent, [](const Sent& one) { return one.topic != "/points"; });
  EXPECT_EQ(all_of(*reader), sent);
}

TEST_F(Rosbag2, AFileThatIsCompressedWholeIsUnpacked) {
  const std::vector<Sent> sent = make("a.db3", 50, 1000);
  shell("zstd -q --rm a.db3 -o a.db3.zstd");
  EXPECT_EQ(all_of(*open_recording(at("a.db3.zstd"))), sent);
  shell("head -c 300 a.db3.zstd > b.db3.zstd");
  EXPECT_THROW(open_recording(at("b.db3.zstd")), IoError);
}

TEST_F(Rosbag2, MessagesThatAreCompressedAreUnpacked) {
  std::vector<Sent> sent = make("a.db3", 3, 1000);
  for (std::size_t i = 0; i < 3; ++i) {
    put("m", sent[i].data);
    shell(
        "zstd -q -f m -o m.zst && sqlite3 a.db3 \"UPDATE messages SET data = readfile('m.zst') WHERE "
        "timestamp = " +
        std::to_string(sent[i].log_time) + "\"");
  }
  EXPECT_EQ(all_of(*open_recording(at("a.db3"))), sent);
  shell("sqlite3 a.db3 \"UPDATE messages SET data = X'28B52FFD0000' WHERE timestamp = " +
        std::to_string(sent[1].log_time) + "\"");
  const auto reader = open_recording(at("a.db3"));
  EXPECT_EQ(all_of(*reader), (std::vector<Sent>{sent[0], sent[2]}));
  EXPECT_THAT(reader->warning_lines(), testing::ElementsAre(testing::StartsWith("zstd: ")));
}

TEST_F(Rosbag2, AFolderOfMcapFilesIsOneRecording) {
  shell("mkdir bag");
  for (const char* name : {"bag/b.mcap", "bag/a.mcap"}) {
    McapWriter writer(at(name));
    writer.add_topic({"/points", "sensor_msgs/msg/PointCloud2", "", {}});
    writer.write(0, name[4], 0, nullptr, 0);
    writer.close();
  }
  put("bag/metadata.yaml",
      "rosbag2_bagfile_information:\n  storage_identifier: mcap\n  relative_file_paths: [a.mcap, b.mcap]\n");
  const auto reader = open_recording(at("bag"));
  EXPECT_EQ(all_of(*reader), (std::vector<Sent>{{"/points", 'a', 0, ""}, {"/points", 'b', 0, ""}}));
  EXPECT_EQ(reader->topics()[0].messages, 2U);
}

// After a crash.
TEST_F(Rosbag2, AFolderOfMcapFilesNeedsNoMetadata) {
  shell("mkdir bag");
  for (const char* name : {"bag/bag_10.mcap", "bag/bag_2.mcap", "bag/bag_0.mcap"}) {
    McapWriter writer(at(name));
    writer.add_topic({"/points", "sensor_msgs/msg/PointCloud2", "", {}});
    writer.write(0, std::atoi(name + 8), 0, nullptr, 0);
    writer.close();
  }
  EXPECT_EQ(all_of(*open_recording(at("bag"))),
            (std::vector<Sent>{{"/points", 0, 0, ""}, {"/points", 2, 0, ""}, {"/points", 10, 0, ""}}));
  put("bag/cloud.pcd", "");  // a folder of clouds with a recording beside them
  EXPECT_FALSE(is_recording(at("bag")));
}

TEST_F(Rosbag2, ReadsTheFilesThatAreThereWhateverItsMetadataSays) {
  shell("mkdir bag");
  const std::vector<Sent> sent = make("bag/bag_1.db3", 20, 1000);
  put("bag/bag_2.db3", "SQLite format 3, but no more");
  put("bag/metadata.yaml",
      "rosbag2_bagfile_information: {relative_file_paths: [bag_0.db3, bag_1.db3, bag_2.db3]}\n");
  const auto reader = open_recording(at("bag"));
  EXPECT_EQ(all_of(*reader), sent);
  EXPECT_THAT(reader->warning_lines(),
              testing::ElementsAre("skipped bag_0.db3: no such file or folder",
                                   testing::StartsWith("skipped bag_2.db3: is no database of SQLite")));
  shell("rm bag/bag_2.db3");
  for (const char* cut :
       {"rosbag2_bagfile_information: {relative_file_paths: [", "rosbag2_bagfile_information:\n"}) {
    put("bag/metadata.yaml", cut);
    const auto again = open_recording(at("bag"));
    EXPECT_EQ(all_of(*again), sent);
    EXPECT_THAT(again->warning_lines(),
                testing::ElementsAre(testing::EndsWith(": all files of the folder are read")));
  }
  put("bag/metadata.yaml",
      "rosbag2_bagfile_information: {relative_file_paths: [bag_1.db3, bag_1.db3, old/bag_1.db3]}\n");
  const auto repeated = open_recording(at("bag"));
  EXPECT_EQ(all_of(*repeated), sent);
  EXPECT_THAT(repeated->warning_lines(),
              testing::ElementsAre("metadata.yaml names bag_1.db3 3 times: it is read once"));
  put("bag/metadata.yaml",
      "rosbag2_bagfile_information: {relative_file_paths: [bag_1.db3, \"a\\nb.db3\"]}\n");
  EXPECT_THAT(open_recording(at("bag"))->warning_lines(),
              testing::Contains("skipped a?b.db3: no such file or folder"));
  put("bag/metadata.yaml", "rosbag2_bagfile_information: {relative_file_paths: [bag_1.db3]}\n");
  make("bag/bag_7.db3", 3, 5000);
  const auto named = open_recording(at("bag"));
  EXPECT_EQ(all_of(*named), sent);
  EXPECT_THAT(named->warning_lines(),
              testing::ElementsAre("bag_7.db3 is not in metadata.yaml and is not read"));
}

// A page of 4 KiB after the other is overwritten, as by a bad sector: the first one with the header and the
// list of tables, the root of the messages, the index of times, what holds rows. Only rows on that page can
// be lost.
TEST_F(Rosbag2, ADamagedPageCostsTheMessagesOnIt) {
  const std::vector<Sent> sent = make("a.db3", 400, 1'700'000'000'000'000'000);
  const std::string bytes = bytes_of("a.db3");
  const std::size_t pages = bytes.size() / 4096;
  std::size_t opened = 0, whole = 0;
  for (std::size_t page = 0; page < pages; ++page) {
    SCOPED_TRACE(page);
    std::string damaged = bytes;
    std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(4096 * page), 4096, '\xAA');
    put("b.db3", damaged);
    try {
      const auto reader = open_recording(at("b.db3"));
      const std::vector<Sent> found = all_of(*reader);
      ++opened;
      whole += found == sent ? 1 : 0;
      EXPECT_GT(found.size(), 250U);
      EXPECT_TRUE(std::includes(sent.begin(), sent.end(), found.begin(), found.end(),
                                [](const Sent& a, const Sent& b) { return a.log_time < b.log_time; }));
      if (found == sent) continue;
      ASSERT_EQ(reader->warning_lines().size(), 1U);
      EXPECT_THAT(reader->warning_lines()[0], testing::HasSubstr("those on damaged pages are lost"));
    } catch (const IoError&) {  // only without the list of topics
    }
  }
  EXPECT_EQ(opened, pages - 1);
  EXPECT_GE(whole, 4U);  // the first page, the root, the schema, the index of times
}

// Larger than a page, as clouds are.
TEST_F(Rosbag2, MessagesOfManyPagesAreReadFromADamagedFile) {
  std::vector<Sent> sent;
  {
    Rosbag2Writer writer(at("out"));
    writer.add_topic({"/points", "sensor_msgs/msg/PointCloud2", "", {}});
    std::mt19937 random(5);
    for (std::int64_t i = 0; i < 20; ++i) {
      std::string data(3000 + random() % 30'000, '\0');
      for (char& c : data)
        c = static_cast<char>(random());
      writer.write(0, i, i, reinterpret_cast<const std::byte*>(data.data()), data.size());
      sent.push_back({"/points", i, i, data});
    }
    writer.close();
  }
  std::string bytes = bytes_of("out/out_0.db3");
  std::fill_n(bytes.begin(), 4096, '\0');
  put("b.db3", bytes);
  EXPECT_EQ(all_of(*open_recording(at("b.db3"))), sent);
}

TEST_F(Rosbag2, WhatIsWrittenIsReadBackByOursAndBySqlite) {
  std::vector<Sent> sent;
  {
    Rosbag2Writer writer(at("out"));
    const std::size_t points = writer.add_topic(
        {"/points", "sensor_msgs/msg/PointCloud2", "", {{"offered_qos_profiles", "- depth: 10"}}});
    const std::size_t other = writer.add_topic({"/it's", "std_msgs/msg/String", "", {}});
    for (int i = 0; i < 50; ++i) {
      const std::string data(static_cast<std::size_t>(i), '\0');
      const std::int64_t time = 1000 + 10 * i - (i % 3) * 15;
      writer.write(i % 2 == 0 ? points : other, time, time, reinterpret_cast<const std::byte*>(data.data()),
                   data.size());
      sent.push_back({i % 2 == 0 ? "/points" : "/it's", time, time, data});
    }
    writer.attach("config.yaml", "application/yaml", "threads: 1\n", 5);
    EXPECT_THROW(writer.write(2, 0, 0, nullptr, 0), std::out_of_range);
    writer.close();
  }
  std::stable_sort(sent.begin(), sent.end(),
                   [](const Sent& a, const Sent& b) { return a.log_time < b.log_time; });
  const auto reader = open_recording(at("out"));
  EXPECT_EQ(all_of(*reader), sent);
  EXPECT_EQ(bytes_of("out/config.yaml"), "threads: 1\n");
  EXPECT_FALSE(std::filesystem::exists(at("out/out_0.db3-wal")));
  shell(
      "sqlite3 out/out_0.db3 \"PRAGMA integrity_check; SELECT count(*), sum(length(data)) FROM messages; "
      "SELECT schema_version, ros_distro FROM schema; SELECT offered_qos_profiles FROM topics WHERE id = 1\" "
      "> said");
  EXPECT_EQ(bytes_of("said"), "ok\n50|1225\n3|humble\n- depth: 10\n");
  const std::string metadata = bytes_of("out/metadata.yaml");
  for (const char* part : {"version: 5", "storage_identifier: sqlite3", "message_count: 50",
                           "nanoseconds_since_epoch: 990", "nanoseconds: 490", "- out_0.db3"})
    EXPECT_THAT(metadata, testing::HasSubstr(part));
  EXPECT_THROW(Rosbag2Writer("/proc/none"), IoError);
}

TEST_F(Rosbag2, OfARecorderThatWasKilledIsReadUpToItsLastTransaction) {
  const std::string copy = at("copy").string();
  Rosbag2Writer writer(at("out"));
  writer.add_topic({"/points", "sensor_msgs/msg/PointCloud2", "", {}});
  writer.write(0, 1, 1, nullptr, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  writer.write(0, 2, 2, nullptr, 0);  // ends a transaction
  writer.write(0, 3, 3, nullptr, 0);
  shell("cp -r out copy");  // what is there if it ends now
  EXPECT_EQ(all_of(*open_recording(at("copy"))).size(), 2U);
}

TEST_F(Rosbag2, SaysWhatIsWrongWithAFolder) {
  shell("mkdir bag");
  const auto error = [&] {
    try {
      open_recording(at("bag"));
    } catch (const IoError& failure) {
      return std::string(failure.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(error(), testing::StartsWith("unknown recording format"));
  put("bag/metadata.yaml", "rosbag2_bagfile_information: {relative_file_paths: [gone.db3]}\n");
  EXPECT_EQ(error(), "gone.db3: no such file or folder");
  put("bag/metadata.yaml", "rosbag2_bagfile_information: {relative_file_paths: [\"a\\nb.db3\"]}\n");
  EXPECT_EQ(error(), "a?b.db3: no such file or folder");
  put("bag/metadata.yaml", "rosbag2_bagfile_information: b: c\n");
  EXPECT_THAT(error(), testing::StartsWith("metadata.yaml: "));
  put("bag/metadata.yaml", "colours: [red]\n");  // of another kind
  EXPECT_THAT(error(), testing::StartsWith("unknown recording format"));
  put("bag/metadata.yaml", "rosbag2_bagfile_information: {relative_file_paths: []}\n");
  EXPECT_EQ(error(), "metadata.yaml names no files");
}

TEST_F(Rosbag2, DamagedAnywhereIsReadOrRefused) {
  make("a.db3", 40, 1000);
  const std::string bytes = bytes_of("a.db3");
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = bytes;
    for (int k = 0; k < 8; ++k)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    put("b.db3", damaged);
    try {
      const auto reader = open_recording(at("b.db3"));
      EXPECT_LT(all_of(*reader).size(), 10'000U);
    } catch (const IoError&) {
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
