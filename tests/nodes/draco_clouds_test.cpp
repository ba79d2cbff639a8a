// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds compressed by Draco's own encoder, with the attributes that draco_point_cloud_transport makes of the
// fields.

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <draco/point_cloud/point_cloud_builder.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>

#include "folder.h"
#include "message_bytes.h"
#include "pcl_bv/messages/compressed_cloud.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/nodes/frame_source.h"
#include "stream/sources/cloud_message.h"
#include "stream/sources/compressed_cloud.h"
#include "stream/sources/recorded_clouds.h"

namespace pcl_bv::detail {
namespace {

using draco::GeometryAttribute;
using test::CompressedCloud;
using test::Encoding;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;
using namespace std::chrono_literals;

constexpr std::uint32_t kPoints = 400;
constexpr float kSize = 100;  // metres

struct Record {
  float x, y, z;
  std::uint32_t id;
  std::uint16_t ring, none;
  std::uint32_t rgb;  // four bytes, whatever its datatype is
};
static_assert(sizeof(Record) == 24);

std::vector<Record> random_records(unsigned seed, std::uint32_t points = kPoints) {
  std::mt19937 dice(seed);
  std::uniform_real_distribution<float> coordinate(0, kSize);
  std::vector<Record> all;
  for (std::uint32_t i = 0; i < points; ++i)
    all.push_back({coordinate(dice), coordinate(dice), coordinate(dice), i,
                   static_cast<std::uint16_t>(dice() % 64), 0, static_cast<std::uint32_t>(dice())});
  return all;
}

CompressedCloud described(std::uint32_t points) {
  return {1,
          points,
          sizeof(Record),
          static_cast<std::uint32_t>(sizeof(Record)) * points,
          "draco",
          {{"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}, {"id", 12, 6}, {"ring", 16, 4}, {"rgb", 20, 7}}};
}

std::unique_ptr<draco::PointCloud> cloud_of(const std::vector<Record>& records, bool deduplicate = false) {
  draco::PointCloudBuilder builder;
  builder.Start(static_cast<std::uint32_t>(records.size()));
  const auto add = [&](GeometryAttribute::Type type, int components, draco::DataType data,
                       const void* first) {
    const int id = builder.AddAttribute(type, static_cast<std::int8_t>(components), data);
    builder.SetAttributeValuesForAllPoints(id, first, sizeof(Record));
  };
  add(GeometryAttribute::POSITION, 1, draco::DT_FLOAT32, &records[0].x);
  add(GeometryAttribute::POSITION, 1, draco::DT_FLOAT32, &records[0].y);
  add(GeometryAttribute::POSITION, 1, draco::DT_FLOAT32, &records[0].z);
  add(GeometryAttribute::GENERIC, 1, draco::DT_UINT32, &records[0].id);
  add(GeometryAttribute::GENERIC, 1, draco::DT_UINT16, &records[0].ring);
  add(GeometryAttribute::COLOR, 4, draco::DT_UINT8, &records[0].rgb);
  auto cloud = builder.Finalize(deduplicate);
  auto metadata = std::make_unique<draco::GeometryMetadata>();
  metadata->AddEntryInt("deduplicate", deduplicate ? 1 : 0);
  cloud->AddMetadata(std::move(metadata));
  return cloud;
}

Bytes encoded(const draco::PointCloud& cloud, int method, int bits = 0) {
  draco::Encoder encoder;
  encoder.SetSpeedOptions(7, 7);
  encoder.SetEncodingMethod(method);
  if (bits > 0) encoder.SetAttributeQuantization(GeometryAttribute::POSITION, bits);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodePointCloudToBuffer(cloud, &buffer);
  EXPECT_TRUE(status.ok()) << status.error_msg_string();
  const auto* const begin = reinterpret_cast<const std::byte*>(buffer.data());
  return {begin, begin + buffer.size()};
}

Frame frame_of(const Bytes& message, CloudType type = CloudType::compressed, bool ros1 = false) {
  Frame frame;
  const auto owner = std::make_shared<Bytes>(message);
  read_cloud_message({owner->data(), owner->size(), owner, ros1, type}, "", frame);
  return frame;
}

std::string refusal(const CompressedCloud& cloud, const Bytes& data) {
  try {
    frame_of(test::compressed_message(Encoding::cdr, cloud, data));
  } catch (const MessageError& error) {
    return error.what();
  }
  return "none";
}

// The bytes of the records, as the message's PointCloud2 has them.
Bytes records_of(const CompressedCloud& cloud, const Bytes& data) {
  const Bytes bytes = test::compressed_message(Encoding::cdr, cloud, data);
  msg::CompressedPointCloud2 message;
  read_cdr(bytes.data(), bytes.size(), message);
  const DecompressedCloud made = decompress(message);
  return {made.cloud.data.data, made.cloud.data.data + made.cloud.data.size};
}

void expect_points(const PointView& view, const std::vector<Record>& records) {
  ASSERT_EQ(view.count, records.size());
  for (std::size_t i = 0; i < view.count; ++i) {
    const Coordinates p = load_point(view, i);
    EXPECT_EQ(p.x, static_cast<double>(records[i].x));
    EXPECT_EQ(p.y, static_cast<double>(records[i].y));
    EXPECT_EQ(p.z, static_cast<double>(records[i].z));
  }
}

TEST(DracoClouds, OfTheSequentialEncodingHaveEveryBitOfTheirFields) {
  const std::vector<Record> records = random_records(1);
  const Bytes data = encoded(*cloud_of(records), draco::POINT_CLOUD_SEQUENTIAL_ENCODING);
  const Bytes found = records_of(described(kPoints), data);
  ASSERT_EQ(found.size(), sizeof(Record) * kPoints);
  EXPECT_EQ(std::memcmp(found.data(), records.data(), found.size()), 0);
  const Frame frame = frame_of(test::compressed_message(Encoding::cdr, described(kPoints), data));
  expect_points(frame.points, records);
  EXPECT_EQ(frame.header.frame_id, "lidar");
}

// The tree changes the order of the points. Their coordinates are rounded to steps of kSize / (2^bits - 1).
TEST(DracoClouds, OfTheTreeHaveTheirPointsWithinAStepOfTheirBits) {
  const std::vector<Record> records = random_records(2);
  for (const int bits : {8, 14}) {
    const Bytes data = encoded(*cloud_of(records), draco::POINT_CLOUD_KD_TREE_ENCODING, bits);
    const Bytes found = records_of(described(kPoints), data);
    ASSERT_EQ(found.size(), sizeof(Record) * kPoints);
    const float step = kSize / std::ldexp(1.F, bits);
    std::vector<bool> seen(kPoints);
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      Record record;
      std::memcpy(&record, found.data() + i * sizeof record, sizeof record);
      ASSERT_LT(record.id, kPoints);
      EXPECT_FALSE(seen[record.id]);
      seen[record.id] = true;
      const Record& original = records[record.id];
      EXPECT_NEAR(record.x, original.x, step);
      EXPECT_NEAR(record.y, original.y, step);
      EXPECT_NEAR(record.z, original.z, step);
      EXPECT_EQ(record.ring, original.ring);
      EXPECT_EQ(record.rgb, original.rgb);
    }
  }
}

// Older publishers leave the width of the cloud with duplicates.
TEST(DracoClouds, WithoutDuplicatesAreShorterThanTheyAnnounce) {
  std::vector<Record> records = random_records(3, 200);
  records.insert(records.end(), records.begin(), records.begin() + 150);
  const Bytes data = encoded(*cloud_of(records, true), draco::POINT_CLOUD_SEQUENTIAL_ENCODING);
  CompressedCloud cloud = described(35);
  cloud.height = 10;
  EXPECT_EQ(frame_of(test::compressed_message(Encoding::cdr, cloud, data)).points.count, 200U);
}

class DracoBags : public Folder {};

TEST_F(DracoBags, OfRos1AreFramesAndInputs) {
  const std::vector<Record> records = random_records(4);
  const Bytes data = encoded(*cloud_of(records), draco::POINT_CLOUD_SEQUENTIAL_ENCODING);
  expect_points(frame_of(test::compressed_message(Encoding::ros1, described(kPoints), data),
                         CloudType::compressed_draco, true)
                    .points,
                records);
  const std::string python = "/usr/bin/python3 ";  // Debian's, which has its modules
  if (std::system((python + "-c 'import rosbag, genpy.dynamic' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "python3-rosbag is not installed";
  write("data", {reinterpret_cast<const char*>(data.data()), data.size()});
  const std::string bag = (path_ / "a.bag").string();
  ASSERT_EQ(std::system((python + PCL_BV_WRITE_CLOUDS_BAG " " + bag + " " + std::to_string(kPoints) + " " +
                         (path_ / "data").string())
                            .c_str()),
            0);
  ReplayOptions options;
  options.own_stamps = true;
  Frame frame;
  ASSERT_EQ(open_source(bag, options)->next(frame, 1000ms), Next::frame);
  EXPECT_EQ(frame.header.stamp_ns, 5'000'000'006);
  expect_points(frame.points, records);
  expect_points(RecordedClouds(bag, "").load(0).xyz(), records);
}

// Every byte is lost, and changed to several values. Damaged values of points are not detected.
TEST(DracoClouds, CutOrDamagedAnywhereAreNoMoreThanAnError) {
  for (const int method : {draco::POINT_CLOUD_SEQUENTIAL_ENCODING, draco::POINT_CLOUD_KD_TREE_ENCODING}) {
    const Bytes data = encoded(*cloud_of(random_records(5, 40)), method, 10);
    ASSERT_EQ(refusal(described(40), data), "none");
    for (std::size_t at = 0; at < data.size(); ++at) {
      const Bytes cut(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(at));
      EXPECT_NE(refusal(described(40), cut), "none") << method << ": " << at;
      for (const unsigned change : {1U, 0x80U, 0xffU, 0x55U}) {
        Bytes damaged = data;
        damaged[at] ^= static_cast<std::byte>(change);
        refusal(described(40), damaged);
      }
    }
  }
}

TEST(DracoClouds, OfOtherSizesThanTheirMessageAnnouncesAreRefused) {
  const Bytes data = encoded(*cloud_of(random_records(6)), draco::POINT_CLOUD_SEQUENTIAL_ENCODING);
  EXPECT_THAT(refusal(described(kPoints - 1), data), HasSubstr("has 400 points; 399 are allowed"));
  CompressedCloud fewer = described(kPoints), other = fewer, beyond = fewer, unknown = fewer;
  fewer.fields.pop_back();
  EXPECT_THAT(refusal(fewer, data), HasSubstr("has 6 attributes for 5 fields"));
  other.fields.back().datatype = 4;
  EXPECT_THAT(refusal(other, data), HasSubstr("has an attribute of 4 bytes for a field of 2"));
  beyond.fields.back().offset = 21;
  EXPECT_THAT(refusal(beyond, data), HasSubstr("a field that exceeds the record of 24 bytes"));
  unknown.fields.back().datatype = 9;
  EXPECT_THAT(refusal(unknown, data), HasSubstr("a field that exceeds the record"));
}

// The points of the header, in a cloud without metadata, are the four bytes at 11; those of the tree come
// after the attributes.
TEST(DracoClouds, ThatAnnounceManyPointsAreRefusedBeforeMemoryIsReserved) {
  for (const int method : {draco::POINT_CLOUD_SEQUENTIAL_ENCODING, draco::POINT_CLOUD_KD_TREE_ENCODING}) {
    const auto cloud = cloud_of(random_records(7));
    cloud->AddMetadata(nullptr);
    Bytes data = encoded(*cloud, method, 10);
    std::uint32_t points = 0;
    std::memcpy(&points, data.data() + 11, 4);
    ASSERT_EQ(points, kPoints);
    points = 20'000'000;
    std::memcpy(data.data() + 11, &points, 4);
    EXPECT_THAT(refusal(described(points), data), HasSubstr("has 20000000 points; ")) << method;
    points = 4'000'000;
    std::memcpy(data.data() + 11, &points, 4);
    EXPECT_NE(refusal(described(points), data), "none");
    if (method == draco::POINT_CLOUD_KD_TREE_ENCODING) {
      EXPECT_THAT(refusal(described(points), data), HasSubstr("has a tree of other points"));
    }
  }
}

TEST(DracoClouds, ThatAreMeshesOrNothingAreRefused) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int id = builder.AddAttribute(GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  builder.SetAttributeValuesForFace(id, draco::FaceIndex(0), corners[0], corners[1], corners[2]);
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(draco::Encoder().EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
  const auto* const begin = reinterpret_cast<const std::byte*>(buffer.data());
  EXPECT_THAT(refusal(described(3), Bytes(begin, begin + buffer.size())), HasSubstr("is no point cloud"));
  EXPECT_THAT(refusal(described(3), {}), HasSubstr("cannot be decoded"));
  EXPECT_THAT(refusal(described(3), Bytes(100)), HasSubstr("cannot be decoded"));
}

}  // namespace
}  // namespace pcl_bv::detail
