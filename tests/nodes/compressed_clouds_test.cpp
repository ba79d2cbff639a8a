// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds compressed as the plugins of point_cloud_transport do it: by Python's zlib and by zstd's own
// library.

#include <gmock/gmock.h>
#include <zstd.h>

#include <cstdlib>
#include <random>

#include "folder.h"
#include "message_bytes.h"
#include "pcl_bv/messages/compressed_cloud.h"
#include "pcl_bv/messages/schema.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/recording/mcap_writer.h"
#include "stream/sources/cloud_message.h"
#include "stream/sources/compressed_cloud.h"
#include "stream/sources/recorded_clouds.h"

namespace pcl_bv::detail {
namespace {

using test::CompressedCloud;
using test::Encoding;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;
using namespace std::chrono_literals;

constexpr std::uint32_t kPoints = 300;

// x, y, z and intensity of random points, rounded so that they can be compressed.
std::vector<float> random_points(unsigned seed) {
  std::mt19937 dice(seed);
  std::vector<float> values(std::size_t{4} * kPoints);
  for (float& value : values)
    value = static_cast<float>(dice() % 1000) / 8;
  return values;
}

Bytes bytes_of(const std::vector<float>& values) {
  const auto* const begin = reinterpret_cast<const std::byte*>(values.data());
  return {begin, begin + 4 * values.size()};
}

Bytes zstd_of(const Bytes& raw, int level = 7) {
  Bytes packed(ZSTD_compressBound(raw.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), level));
  return packed;
}

void expect_points(const PointView& view, const std::vector<float>& values) {
  ASSERT_EQ(view.count, values.size() / 4);
  for (std::size_t i = 0; i < view.count; ++i) {
    const Coordinates p = load_point(view, i);
    EXPECT_EQ(p.x, static_cast<double>(values[4 * i]));
    EXPECT_EQ(p.y, static_cast<double>(values[4 * i + 1]));
    EXPECT_EQ(p.z, static_cast<double>(values[4 * i + 2]));
  }
}

class CompressedClouds : public Folder {
 protected:
  // Returns what Python's `function` makes of the bytes.
  Bytes python_packed(const std::string& function, const Bytes& raw) {
    const std::string in = (path_ / "raw").string(), out = (path_ / "packed").string();
    write("raw", {reinterpret_cast<const char*>(raw.data()), raw.size()});
    const std::string call = "/usr/bin/python3 -c 'import sys, zlib, gzip; open(sys.argv[2], \"wb\").write(" +
                             function + "(open(sys.argv[1], \"rb\").read()))' " + in + ' ' + out;
    EXPECT_EQ(std::system(call.c_str()), 0) << call;
    const std::string text = read("packed");
    const auto* const begin = reinterpret_cast<const std::byte*>(text.data());
    return {begin, begin + text.size()};
  }

  Frame frame_of(const Bytes& message, const std::string& class_field = {}) {
    Frame frame;
    const auto owner = std::make_shared<Bytes>(message);
    read_cloud_message({owner->data(), owner->size(), owner, false, CloudType::compressed}, class_field,
                       frame);
    return frame;
  }

  std::string refusal(const Bytes& message) {
    try {
      frame_of(message);
    } catch (const MessageError& error) {
      return error.what();
    }
    return "none";
  }
};

CompressedCloud described(const std::string& format) {
  return {1, kPoints, 16, 16 * kPoints, format};
}

// The plugin writes gzip under the name zlib, and its reader takes both.
TEST_F(CompressedClouds, OfZlibAreThePointsThatWereCompressed) {
  const std::vector<float> values = random_points(1);
  for (const char* function : {"zlib.compress", "gzip.compress"}) {
    const Bytes packed = python_packed(function, bytes_of(values));
    ASSERT_LT(packed.size(), 4 * values.size());
    const Frame frame = frame_of(test::compressed_message(Encoding::cdr, described("zlib"), packed));
    expect_points(frame.points, values);
    EXPECT_EQ(frame.header.frame_id, "lidar");
    EXPECT_EQ(frame.header.stamp_ns, 5'000'000'006);
    ASSERT_TRUE(frame.intensity);
    EXPECT_EQ(frame.intensity->at(7), values[31]);
  }
}

TEST_F(CompressedClouds, OfZstdAreThePointsThatWereCompressed) {
  const std::vector<float> values = random_points(2);
  for (const int level : {-1, 1, 9, 19}) {
    const Bytes packed = zstd_of(bytes_of(values), level);
    expect_points(frame_of(test::compressed_message(Encoding::cdr, described("zstd"), packed)).points,
                  values);
  }
}

TEST_F(CompressedClouds, MayHaveAWrongRowStepAndNoHeight) {
  const std::vector<float> values = random_points(3);
  for (const std::uint32_t height : {0U, 1U}) {
    const CompressedCloud cloud{height, kPoints, 16, 3, "zstd"};
    expect_points(frame_of(test::compressed_message(Encoding::cdr, cloud, zstd_of(bytes_of(values)))).points,
                  values);
  }
}

TEST_F(CompressedClouds, InARecordingAreFramesAndInputs) {
  const std::vector<float> values = random_points(4);
  const std::string file = (path_ / "a.mcap").string();
  {
    const char* const type = msg::CompressedPointCloud2::ros_type;
    McapWriter writer(file);
    const std::size_t topic = writer.add_topic({"/points/zstd", type, schema_of(type), {}});
    const Bytes message =
        test::compressed_message(Encoding::cdr, described("zstd"), zstd_of(bytes_of(values)));
    writer.write(topic, 1, 1, message.data(), message.size());
    writer.close();
  }
  ReplayOptions options;
  options.own_stamps = true;
  Frame frame;
  ASSERT_EQ(open_source(file, options)->next(frame, 1000ms), Next::frame);
  expect_points(frame.points, values);
  expect_points(RecordedClouds(file, "").load(0).xyz(), values);
}

TEST_F(CompressedClouds, CutOrDamagedAnywhereAreNoMoreThanAnError) {
  const Bytes raw = bytes_of(random_points(5));
  for (const std::string format : {"zlib", "gzip", "zstd"}) {
    const Bytes packed = format == "zstd" ? zstd_of(raw) : python_packed(format + ".compress", raw);
    const CompressedCloud cloud = described(format == "zstd" ? "zstd" : "zlib");
    for (std::size_t size = 0; size < packed.size(); ++size) {
      Bytes cut(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_NE(refusal(test::compressed_message(Encoding::cdr, cloud, cut)), "none") << format << size;
      cut = packed;
      cut[size] ^= std::byte{0x55};  // zstd has no checksum here: other points are possible
      refusal(test::compressed_message(Encoding::cdr, cloud, cut));
    }
  }
}

TEST_F(CompressedClouds, ThatGrowBeyondWhatTheyAnnounceAreRefused) {
  const Bytes zeros(std::size_t{64} << 20U);
  const Bytes small = zstd_of(zeros), deflated = python_packed("zlib.compress", zeros);
  EXPECT_THAT(refusal(test::compressed_message(Encoding::cdr, described("zstd"), small)),
              HasSubstr("zstd: more than 4800 bytes"));
  EXPECT_THAT(refusal(test::compressed_message(Encoding::cdr, described("zlib"), deflated)),
              HasSubstr("zlib: more than 4800 bytes"));
}

TEST_F(CompressedClouds, ThatAnnounceMoreThanTheyHaveAreRefused) {
  const Bytes packed = zstd_of(bytes_of(random_points(6)));
  const auto with = [&](const CompressedCloud& cloud) {
    return refusal(test::compressed_message(Encoding::cdr, cloud, packed));
  };
  EXPECT_THAT(with({1, kPoints + 1, 16, 16 * (kPoints + 1), "zstd"}), HasSubstr("but has only 4800 bytes"));
  EXPECT_THAT(with({1U << 16U, 1U << 16U, 16, 1U << 20U, "zstd"}), HasSubstr("512 MiB are allowed"));
  EXPECT_THAT(with({~0U, ~0U, ~0U, ~0U, "zstd"}), HasSubstr("512 MiB are allowed"));
}

TEST_F(CompressedClouds, OfAnotherFormatNameIt) {
  EXPECT_THAT(refusal(test::compressed_message(Encoding::cdr, described("cloudini"), {})),
              HasSubstr("compressed as 'cloudini'"));
  // This test does not lie next to the folder of the modules.
  EXPECT_THAT(refusal(test::compressed_message(Encoding::cdr, described("draco"), {})),
              HasSubstr("pcl_bv_draco.so is not installed; it belongs to the component `draco`"));
}

TEST_F(CompressedClouds, CutAnywhereInTheMessageAreRefused) {
  const Bytes message =
      test::compressed_message(Encoding::cdr, described("zstd"), zstd_of(bytes_of(random_points(7))));
  for (std::size_t size = 0; size < message.size(); ++size)
    EXPECT_NE(refusal({message.begin(), message.begin() + static_cast<std::ptrdiff_t>(size)}), "none")
        << size;
}

}  // namespace
}  // namespace pcl_bv::detail
