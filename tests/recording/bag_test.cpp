// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/serialize.h"
#include "recording_files.h"

namespace pcl_bv::detail {
namespace {

constexpr const char* kPython = "/usr/bin/python3";  // Debian's, which has its modules

std::string hex_of(const std::string& data) {
  std::string text;
  for (const char c : data) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned char>(c));
    text += digits;
  }
  return text;
}

std::string output_of(const std::string& command) {
  std::string output;
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    output.append(buffer.data(), n);
  return ::pclose(pipe) == 0 ? output : "";
}

class Bag : public RecordingFiles {
 protected:
  void SetUp() override {
    RecordingFiles::SetUp();
    if (output_of(std::string(kPython) + " -c 'import rosbag, sensor_msgs.msg; print(1)' 2>/dev/null")
            .empty())
      GTEST_SKIP() << "python3-rosbag is not installed";
  }

  // By ROS's own writer; what its own reader finds.
  nlohmann::json make(const std::string& compression) const {
    return nlohmann::json::parse(output_of(std::string(kPython) + " " PCL_BV_WRITE_BAG " " +
                                           at("a.bag").string() + " " + compression));
  }
};

nlohmann::json found_in(RecordingReader& reader) {
  nlohmann::json found = nlohmann::json::array();
  for (const Sent& sent : all_of(reader)) {
    std::string type;
    for (const RecordedTopic& topic : reader.topics()) {
      if (topic.name == sent.topic) type = topic.type;
    }
    type.erase(type.find("/msg"), 4);
    found.push_back({sent.topic, sent.log_time, type, hex_of(sent.data)});
  }
  return found;
}

TEST_F(Bag, GivesWhatRossOwnReaderGives) {
  for (const char* compression : {"none", "bz2", "lz4"}) {
    const nlohmann::json expected = make(compression);
    ASSERT_EQ(expected.size(), 120U);
    const auto reader = open_recording(at("a.bag"));
    const nlohmann::json found = found_in(*reader);
    ASSERT_EQ(found.size(), 120U);
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_EQ(found[i], expected[i]) << compression << ", message " << i;
    EXPECT_THAT(reader->warning_lines(), testing::IsEmpty());
    ASSERT_EQ(reader->topics().size(), 2U);
    EXPECT_EQ(reader->topics()[0].messages + reader->topics()[1].messages, 120U);
    EXPECT_EQ(reader->topics()[0].encoding, "ros1");
  }
}

TEST_F(Bag, HoldsCloudsThatReadBack) {
  make("lz4");
  const auto reader = open_recording(at("a.bag"));
  std::size_t clouds = 0;
  for (RecordedMessage message; reader->next(message);) {
    if (reader->topics()[message.topic].type != msg::PointCloud2::ros_type) continue;
    msg::PointCloud2 cloud;
    read_ros1(message.data, message.size, cloud);
    EXPECT_EQ(cloud.header.frame_id, "velodyne");
    EXPECT_EQ(cloud.data.size, 12 * cloud.width);
    std::vector<std::byte> again;
    write_ros1(cloud, again);
    again[0] = message.data[0];  // the sequence number, which ROS 2 has none of
    EXPECT_TRUE(std::equal(again.begin(), again.end(), message.data, message.data + message.size));
    ++clouds;
  }
  EXPECT_EQ(clouds, 80U);
}

TEST_F(Bag, ThatWasNotClosedOrIsCutHasEveryWholeChunk) {
  const nlohmann::json expected = make("bz2");
  const std::string bytes = bytes_of("a.bag");
  std::size_t before = 0;
  for (std::size_t size = 13; size < bytes.size(); size += 997) {
    put("cut.bag", bytes.substr(0, size));
    const auto reader = open_recording(at("cut.bag"));
    const nlohmann::json found = found_in(*reader);
    ASSERT_GE(found.size(), before) << size;
    for (const auto& message : found)
      EXPECT_NE(std::find(expected.begin(), expected.end(), message), expected.end());
    EXPECT_FALSE(reader->warning_lines().empty());
    before = found.size();
  }
  EXPECT_EQ(before, 120U);
}

TEST_F(Bag, ADamagedChunkCostsThatChunk) {
  for (const char* compression : {"bz2", "lz4"}) {
    const std::size_t all = make(compression).size();
    std::string bytes = bytes_of("a.bag");
    const std::size_t chunk = bytes.find("compression=", 2 * 4096);
    ASSERT_NE(chunk, std::string::npos);
    for (std::size_t i = 0; i < 40; ++i)
      bytes[chunk + 100 + i] = '\x55';
    put("b.bag", bytes);
    const auto reader = open_recording(at("b.bag"));
    const std::size_t found = all_of(*reader).size();
    EXPECT_LT(found, all);
    EXPECT_GT(found, all / 2);
    ASSERT_EQ(reader->warning_lines().size(), 1U);
    EXPECT_THAT(reader->warning_lines()[0], testing::StartsWith("skipped the chunk at byte "));
  }
}

// Not closed, and with a record between the chunks that says it is longer than the file.
TEST_F(Bag, GoesOnBehindDamageBetweenChunks) {
  const nlohmann::json expected = make("none");
  std::string bytes = bytes_of("a.bag");
  const std::size_t second = bytes.find("compression=", bytes.find("compression=") + 1);
  ASSERT_NE(second, std::string::npos);
  for (std::size_t at = second - 12; at < second - 4; ++at)
    bytes[at] = '\x7F';  // the length of what is before, or of the header
  bytes.replace(bytes.find("index_pos=") + 10, 8, std::string(8, '\0'));
  put("b.bag", bytes);
  const auto reader = open_recording(at("b.bag"));
  const nlohmann::json found = found_in(*reader);
  EXPECT_GT(found.size(), expected.size() / 2);
  EXPECT_LT(found.size(), expected.size());
  for (const auto& message : found)
    EXPECT_NE(std::find(expected.begin(), expected.end(), message), expected.end());
  EXPECT_THAT(reader->warning_lines(), testing::Contains(testing::StartsWith("skipped damaged bytes ")));
}

// Where the records of this kind have this field, whose bytes come after its name.
std::vector<std::size_t> fields_of(const std::string& bytes, char op, const std::string& field) {
  std::vector<std::size_t> found;
  const std::string mark = std::string("op=") + op;
  for (std::size_t at = bytes.find(mark); at != std::string::npos; at = bytes.find(mark, at + 1)) {
    const std::size_t begin = bytes.rfind(field, at), end = bytes.find(field, at);
    const bool before = begin != std::string::npos && (end == std::string::npos || at - begin < end - at);
    found.push_back((before ? begin : end) + field.size());
  }
  return found;
}

TEST_F(Bag, OneChunkIsReadOnceHoweverOftenTheIndexNamesIt) {
  const nlohmann::json expected = make("none");
  std::string bytes = bytes_of("a.bag");
  const std::vector<std::size_t> places = fields_of(bytes, '\x06', "chunk_pos=");
  ASSERT_GE(places.size(), 3U);
  bytes.replace(places[1], 8, bytes.substr(places[0], 8));
  put("b.bag", bytes);
  const auto reader = open_recording(at("b.bag"));
  EXPECT_EQ(found_in(*reader), expected);
  EXPECT_THAT(reader->warning_lines(), testing::Contains(testing::HasSubstr("the index is incomplete")));
}

// The first chunk says that it holds the second one, too.
TEST_F(Bag, AChunkWithinAnotherIsReadOnce) {
  const nlohmann::json expected = make("none");
  std::string bytes = bytes_of("a.bag");
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, size);
    return static_cast<std::size_t>(value);
  };
  const std::vector<std::size_t> places = fields_of(bytes, '\x06', "chunk_pos=");
  ASSERT_GE(places.size(), 3U);
  const std::size_t first = number(places[0], 8), third = number(places[2], 8);
  const std::size_t data = first + 4 + number(first, 4);
  const auto longer = static_cast<std::uint32_t>(third - data - 4);
  std::memcpy(bytes.data() + data, &longer, 4);
  std::memcpy(bytes.data() + bytes.find("size=", first) + 5, &longer, 4);
  put("b.bag", bytes);
  const auto reader = open_recording(at("b.bag"));
  const nlohmann::json found = found_in(*reader);
  EXPECT_LT(found.size(), expected.size());
  EXPECT_GT(found.size(), expected.size() / 2);
  EXPECT_THAT(reader->warning_lines(),
              testing::ElementsAre("skipped the chunk at byte " + std::to_string(first) +
                                   ": the chunk overlaps the next one"));
}

TEST_F(Bag, DamagedAnywhereIsReadOrRefused) {
  make("lz4");
  const std::string bytes = bytes_of("a.bag");
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = bytes;
    for (int k = 0; k < 4; ++k)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    put("b.bag", damaged);
    try {
      const auto reader = open_recording(at("b.bag"));
      EXPECT_LE(all_of(*reader).size(), 120U);
    } catch (const IoError&) {
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
