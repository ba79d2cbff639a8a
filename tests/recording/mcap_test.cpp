// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "made_mcap.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/recording/mcap_writer.h"
#include "pcl_bv/recording/recording.h"
#include "recording_files.h"

namespace pcl_bv::detail {
namespace {

class Mcap : public RecordingFiles {
 protected:
  // Three topics, times that go to and fro by up to `jitter`, compressible data of 0 to 999 bytes.
  std::vector<Sent> record(const std::string& name, Compression compression, std::size_t messages = 300,
                           std::int64_t jitter = 500) const {
    std::mt19937 random(7);
    std::vector<Sent> sent;
    McapWriter writer(at(name), {compression, 4096});
    for (const char* topic : {"/points", "/objects", "/never"})
      writer.add_topic({topic, "std_msgs/msg/Header", "int32 nothing\n", {}});
    for (std::size_t i = 0; i < messages; ++i) {
      const std::size_t topic = random() % 2;
      const auto time =
          static_cast<std::int64_t>(1000 + 20 * i + random() % static_cast<unsigned>(jitter + 1));
      std::string data(random() % 1000, static_cast<char>('a' + i % 26));
      for (std::size_t k = 0; k < data.size(); k += 7)
        data[k] = static_cast<char>(random());
      writer.write(topic, time, time - 5, reinterpret_cast<const std::byte*>(data.data()), data.size());
      sent.push_back({topic == 0 ? "/points" : "/objects", time, time - 5, data});
    }
    writer.attach("config.yaml", "application/yaml", "threads: 2\n", 99);
    writer.close();
    std::stable_sort(sent.begin(), sent.end(),
                     [](const Sent& a, const Sent& b) { return a.log_time < b.log_time; });
    return sent;
  }
};

TEST_F(Mcap, GivesWhatWasWrittenInTheOrderOfTheTimes) {
  for (const Compression compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    const std::vector<Sent> sent = record("a.mcap", compression);
    const auto reader = open_recording(at("a.mcap"));
    EXPECT_EQ(all_of(*reader), sent);
    EXPECT_THAT(reader->warning_lines(), testing::IsEmpty());
    ASSERT_EQ(reader->topics().size(), 3U);
    EXPECT_EQ(reader->topics()[0].name, "/points");
    EXPECT_EQ(reader->topics()[0].type, "std_msgs/msg/Header");
    EXPECT_EQ(reader->topics()[0].encoding, "cdr");
    EXPECT_EQ(reader->topics()[0].messages + reader->topics()[1].messages, sent.size());
    EXPECT_EQ(reader->topics()[2].messages, 0U);
  }
}

TEST_F(Mcap, ReadersOfOneFileShareItsUnpackedChunks) {
  for (const Compression compression : {Compression::lz4, Compression::zstd}) {
    const std::vector<Sent> sent = record("a.mcap", compression);
    auto one = open_recording(at("a.mcap"));
    const auto other = open_recording(at("a.mcap"));
    RecordedMessage a, b;
    std::size_t shared = 0;
    for (const Sent& expected : sent) {
      ASSERT_TRUE(one->next(a) && other->next(b));
      shared += a.data == b.data;
      EXPECT_EQ(std::string(reinterpret_cast<const char*>(b.data), b.size), expected.data);
    }
    EXPECT_EQ(shared, sent.size());
    one->select({0, 1});
    ASSERT_TRUE(one->next(a));
    const std::string last(reinterpret_cast<const char*>(b.data), b.size);
    one.reset();
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(b.data), b.size), last) << "read by the other reader";
  }
}

TEST_F(Mcap, ReadersOfOneFileGiveTheirOwnTopicsInTurn) {
  for (const Compression compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    const std::vector<Sent> sent = record("a.mcap", compression);
    const auto points = open_recording(at("a.mcap")), objects = open_recording(at("a.mcap"));
    points->select({0});
    objects->select({1});
    for (const Sent& expected : sent) {
      RecordedMessage message;
      ASSERT_TRUE((expected.topic == "/points" ? points : objects)->next(message));
      EXPECT_EQ(std::string(reinterpret_cast<const char*>(message.data), message.size), expected.data);
    }
  }
}

TEST_F(Mcap, AReaderOfAFileThatWasWrittenAgainHasNothingOfTheOldOne) {
  record("a.mcap", Compression::zstd);
  const auto old = open_recording(at("a.mcap")), old_too = open_recording(at("a.mcap"));
  RecordedMessage message;
  ASSERT_TRUE(old->next(message));
  const std::vector<Sent> sent = record("a.mcap", Compression::zstd, 50);
  const auto now = open_recording(at("a.mcap")), now_too = open_recording(at("a.mcap"));
  EXPECT_EQ(all_of(*now), sent);
  EXPECT_EQ(all_of(*now_too), sent);
}

TEST_F(Mcap, GivesTheTopicsAskedForFromTheBeginning) {
  std::vector<Sent> sent = record("a.mcap", Compression::zstd);
  const auto reader = open_recording(at("a.mcap"));
  EXPECT_EQ(all_of(*reader).size(), sent.size());
  reader->select({1});
  std::erase_if(sent, [](const Sent& one) { return one.topic != "/objects"; });
  EXPECT_EQ(all_of(*reader), sent);
  reader->select({2});
  EXPECT_TRUE(all_of(*reader).empty());
  EXPECT_THROW(reader->select({3}), std::out_of_range);
}

// Where the first chunk begins and ends, by the index of chunks.
std::size_t find_op(const std::string& bytes, mcap::Op op, std::size_t from) {
  for (std::size_t at = from; at + mcap::kRecordStart <= bytes.size();) {
    if (static_cast<mcap::Op>(bytes[at]) == op) return at;
    std::uint64_t size;
    std::memcpy(&size, bytes.data() + at + 1, 8);
    at += mcap::kRecordStart + size;
  }
  return bytes.size();
}

TEST_F(Mcap, OfARecorderThatWasKilledHasEveryWholeChunk) {
  for (const Compression compression : {Compression::none, Compression::zstd}) {
    const std::vector<Sent> sent = record("a.mcap", compression, 60, 0);
    const std::string bytes = bytes_of("a.mcap");
    std::size_t before = 0;
    for (std::size_t size = 8; size < bytes.size(); size += size < 300 ? 1 : 211) {
      put("cut.mcap", bytes.substr(0, size));
      const auto reader = open_recording(at("cut.mcap"));
      const std::vector<Sent> found = all_of(*reader);
      ASSERT_LE(found.size(), sent.size());
      ASSERT_GE(found.size(), before) << size;
      ASSERT_TRUE(std::equal(found.begin(), found.end(), sent.begin())) << size;
      EXPECT_FALSE(reader->warning_lines().empty()) << size;
      before = found.size();
    }
    EXPECT_EQ(before, sent.size());
  }
}

TEST_F(Mcap, ADamagedChunkCostsThatChunk) {
  for (const Compression compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    const std::vector<Sent> sent = record("a.mcap", compression, 100, 0);
    std::string bytes = bytes_of("a.mcap");
    const std::size_t first = find_op(bytes, mcap::Op::chunk, 8);
    const std::size_t second = find_op(
        bytes, mcap::Op::chunk, first + mcap::kRecordStart + [&] {
          std::uint64_t size;
          std::memcpy(&size, bytes.data() + first + 1, 8);
          return size;
        }());
    for (const bool indexed : {true, false}) {
      std::string damaged = bytes;
      damaged[second + 300] ^= 4;
      if (!indexed) damaged.resize(damaged.size() - 20);
      put("b.mcap", damaged);
      const auto reader = open_recording(at("b.mcap"));
      const std::vector<Sent> found = all_of(*reader);
      EXPECT_LT(found.size(), sent.size());
      EXPECT_GT(found.size(), sent.size() * 3 / 4);
      EXPECT_TRUE(std::includes(sent.begin(), sent.end(), found.begin(), found.end(),
                                [](const Sent& a, const Sent& b) { return a.log_time < b.log_time; }));
      EXPECT_THAT(reader->warning_lines(),
                  testing::Contains(testing::HasSubstr(" at byte " + std::to_string(second))));
    }
  }
}

TEST_F(Mcap, DamagedAnywhereIsReadOrRefused) {
  record("a.mcap", Compression::lz4, 20, 0);
  const std::string bytes = bytes_of("a.mcap");
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = bytes;
    for (int k = 0; k < 3; ++k)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    put("b.mcap", damaged);
    try {
      const auto reader = open_recording(at("b.mcap"));
      EXPECT_LE(all_of(*reader).size(), 20U);
    } catch (const IoError&) {
    }
  }
}

// Without chunks and without a summary, as the simplest writers do.
TEST_F(Mcap, WithoutChunksIsReadInTheOrderOfTheTimes) {
  std::vector<std::byte> bytes;
  mcap::Writer writer(bytes);
  writer.bytes(mcap::kMagic.data(), mcap::kMagic.size());
  mcap::put(writer, mcap::Schema{1, "sensor_msgs/PointCloud2", "ros1msg", ""});
  mcap::put(writer, mcap::Channel{5, 1, "/points", "ros1", {}});
  for (const std::uint64_t time : {30U, 10U, 20U}) {
    writer.begin(mcap::Op::message);
    writer.number(std::uint16_t{5});
    writer.number(std::uint32_t{0});
    writer.number(time);
    writer.number(time + 1);
    writer.bytes("abc", 3);
    writer.end();
  }
  put("a.mcap", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  const auto reader = open_recording(at("a.mcap"));
  ASSERT_EQ(reader->topics().size(), 1U);
  EXPECT_EQ(reader->topics()[0].type, "sensor_msgs/msg/PointCloud2");
  EXPECT_EQ(reader->topics()[0].encoding, "ros1");
  EXPECT_EQ(all_of(*reader),
            (std::vector<Sent>{
                {"/points", 10, 11, "abc"}, {"/points", 20, 21, "abc"}, {"/points", 30, 31, "abc"}}));
}

TEST_F(Mcap, WhoseSummaryDoesNotDescribeItsChannelsIsReadWithoutIt) {
  for (const bool schema : {false, true}) {
    for (const bool channel : {false, true}) {
      SCOPED_TRACE(testing::Message() << "schema " << schema << ", channel " << channel);
      const mcap::Statistics said{3, 1, 1, 0, 0, 1, 1, 3, {{5, 3}}};
      put("a.mcap", McapBuilder().chunk({1, 2, 3}, true).closed(schema, channel, &said));
      const auto reader = open_recording(at("a.mcap"));
      ASSERT_EQ(reader->topics().size(), 1U);
      EXPECT_EQ(reader->topics()[0].type, "sensor_msgs/msg/PointCloud2");
      EXPECT_EQ(times_of(*reader), (std::vector<std::int64_t>{1, 2, 3}));
    }
  }
}

TEST_F(Mcap, HasItsMessagesOutsideOfChunksToo) {
  const mcap::Statistics statistics{6, 1, 1, 0, 0, 2, 1, 6, {{5, 6}}};
  for (const mcap::Statistics* said : {&statistics, static_cast<const mcap::Statistics*>(nullptr)}) {
    McapBuilder made;
    made.loose(1).chunk({2, 4}, true).loose(5).chunk({6}, false).loose(3).loose(7);
    put("a.mcap", made.closed(true, true, said));
    const auto reader = open_recording(at("a.mcap"));
    EXPECT_EQ(times_of(*reader), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 7}));
    EXPECT_THAT(reader->warning_lines(), testing::IsEmpty());
    EXPECT_EQ(reader->topics()[0].messages, 0U);  // seven, not six: who wants to know must count
  }
}

TEST_F(Mcap, HasChunksThatItsSummaryDoesNotName) {
  const std::string head = McapBuilder().without_summary();
  const std::string second = McapBuilder().chunk({3}, false).without_summary().substr(head.size());
  const mcap::Statistics said{2, 1, 1, 0, 0, 1, 1, 2, {{5, 2}}};
  McapBuilder made;
  const std::size_t first_end = made.chunk({1, 2}, true).without_summary().size();
  std::string bytes = made.closed(true, true, &said);
  bytes.insert(first_end, second);
  const std::size_t footer = bytes.size() - mcap::kFileEnd + mcap::kRecordStart;
  std::uint64_t start;  // of the summary, which lies farther behind now
  std::memcpy(&start, bytes.data() + footer, 8);
  start += second.size();
  std::memcpy(bytes.data() + footer, &start, 8);
  put("a.mcap", bytes);
  const auto reader = open_recording(at("a.mcap"));
  EXPECT_EQ(times_of(*reader), (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(reader->topics()[0].messages, 0U);  // nobody knows without counting
}

// Without an index what is behind the damage is found by the fields of chunks, which agree with one another.
TEST_F(Mcap, GoesOnBehindDamageBetweenChunks) {
  for (const char* junk : {"\x01\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x7F", "????????????????????????", "\x07\x30"}) {
    McapBuilder made;
    made.chunk({1, 2}, true).junk(junk).junk("..............").chunk({3}, false).chunk({4}, false);
    put("a.mcap", made.without_summary());
    const auto reader = open_recording(at("a.mcap"));
    EXPECT_EQ(times_of(*reader), (std::vector<std::int64_t>{1, 2, 3, 4})) << junk;
    EXPECT_THAT(reader->warning_lines(), testing::Contains(testing::StartsWith("skipped damaged bytes ")));
  }
}

TEST_F(Mcap, AChunkWithADamagedRecordHasTheMessagesBeforeIt) {
  for (const bool indexed : {true, false}) {
    McapBuilder made;
    made.chunk({1, 2, 3}, true).chunk({4}, false);
    std::string bytes = indexed ? made.closed(true, true, nullptr) : made.without_summary();
    const std::size_t third = bytes.find("abc", bytes.find("abc", bytes.find("abc") + 1) + 1) - 22 - 8;
    bytes[third + 6] = '\x7F';  // its length
    put("a.mcap", bytes);
    const auto reader = open_recording(at("a.mcap"));
    EXPECT_EQ(times_of(*reader), (std::vector<std::int64_t>{1, 2, 4})) << indexed;
    EXPECT_FALSE(reader->warning_lines().empty());
  }
}

TEST_F(Mcap, OfNoMessagesIsEmpty) {
  McapWriter(at("a.mcap")).close();
  const auto reader = open_recording(at("a.mcap"));
  EXPECT_TRUE(reader->topics().empty());
  EXPECT_TRUE(all_of(*reader).empty());
}

TEST_F(Mcap, RefusesTopicsThatAreNotThere) {
  McapWriter writer(at("a.mcap"));
  EXPECT_THROW(writer.write(0, 0, 0, nullptr, 0), std::out_of_range);
  EXPECT_THROW(McapWriter("/no/such/folder/a.mcap"), IoError);
}

TEST_F(Mcap, ThatCannotBeWrittenSaysSo) {
  McapWriter full("/dev/full");
  EXPECT_THROW(full.close(), IoError);
}

}  // namespace
}  // namespace pcl_bv::detail
