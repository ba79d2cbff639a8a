// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Frames from clouds that are not PointCloud2: from recordings, and from a middleware, which here is a list.

#include <gmock/gmock.h>

#include <cstdlib>

#include "folder.h"
#include "message_bytes.h"
#include "pcl_bv/messages/livox.h"
#include "pcl_bv/messages/schema.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/recording/mcap_writer.h"
#include "stream/middleware.h"
#include "stream/sources/cloud_message.h"
#include "stream/sources/message_source.h"
#include "stream/sources/recorded_clouds.h"

namespace pcl_bv::detail {
namespace {

using test::Encoding;
using Bytes = std::vector<std::byte>;
using namespace std::chrono_literals;

constexpr std::uint32_t kPoints = 50;

void expect_livox_points(const PointView& view) {
  ASSERT_EQ(view.count, kPoints);
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const test::LivoxPoint p(i);
    const Coordinates found = load_point(view, i);
    EXPECT_EQ(found.x, static_cast<double>(p.x));
    EXPECT_EQ(found.y, static_cast<double>(p.y));
    EXPECT_EQ(found.z, static_cast<double>(p.z));
  }
}

void expect_livox(const Frame& frame) {
  EXPECT_EQ(frame.header.frame_id, "livox_frame");
  EXPECT_EQ(frame.note, "");
  expect_livox_points(frame.points);
  ASSERT_TRUE(frame.intensity && frame.times);
  EXPECT_EQ(frame.times->type, 'U');
  EXPECT_EQ(frame.times->size, 4U);
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    EXPECT_EQ(frame.times->number(i), test::LivoxPoint(i).offset_time);
    EXPECT_EQ(frame.intensity->number(i), test::LivoxPoint(i).reflectivity);
  }
}

ReplayOptions as_recorded() {
  ReplayOptions options;
  options.own_stamps = true;
  return options;
}

class CloudMessages : public Folder {
 protected:
  std::string file() const { return (path_ / "a.mcap").string(); }

  // Records each message on the topic of its type: "/0", "/1", ...
  void record(const std::vector<std::pair<std::string, Bytes>>& messages) const {
    McapWriter writer(file(), {Compression::none, 1});
    std::int64_t time = 0;
    for (const auto& [type, bytes] : messages) {
      const std::size_t topic = writer.add_topic({"/" + std::to_string(time), type, schema_of(type), {}});
      writer.write(topic, ++time, 0, bytes.data(), bytes.size());
    }
    writer.close();
  }

  Frame frame_of(const ReplayOptions& options = as_recorded()) const {
    Frame frame;
    EXPECT_EQ(open_source(file(), options)->next(frame, 1000ms), Next::frame);
    return frame;
  }
};

// One message of a type.
class OneMessage final : public MessageReceiver {
 public:
  OneMessage(std::size_t type, const Bytes& bytes) : type_(type), bytes_(std::make_shared<Bytes>(bytes)) {}
  bool next(ReceivedMessage& message, std::chrono::milliseconds) override {
    if (bytes_ == nullptr) return false;
    const std::shared_ptr<Bytes> bytes = std::exchange(bytes_, nullptr);
    message = {bytes->data(), bytes->size(), bytes, 77, type_};
    return true;
  }

 private:
  std::size_t type_;
  std::shared_ptr<Bytes> bytes_;
};

std::size_t number_of(const std::string& type) {
  const std::vector<std::string>& names = cloud_type_names();
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), type) - names.begin());
}

TEST_F(CloudMessages, OfALivoxAreFramesWithTimesAndIntensities) {
  for (const char* type : {msg::CustomMsg::ros_type, msg::CustomMsg::old_ros_type}) {
    for (const Encoding encoding : {Encoding::cdr, Encoding::big_endian_cdr}) {
      record({{type, test::livox_message(encoding, kPoints)}});
      const Frame frame = frame_of();
      EXPECT_EQ(frame.header.stamp_ns, 5'000'000'006);
      expect_livox(frame);
      expect_livox_points(RecordedClouds(file(), "").load(0).xyz());
    }
  }
}

TEST_F(CloudMessages, OfALivoxHaveClassesByTheirSmallFields) {
  record({{msg::CustomMsg::ros_type, test::livox_message(Encoding::cdr, kPoints)}});
  ReplayOptions options = as_recorded();
  options.class_field = "line";
  const Frame frame = frame_of(options);
  expect_livox(frame);
  ASSERT_TRUE(frame.classes);
  for (std::uint32_t i = 0; i < kPoints; ++i)
    EXPECT_EQ((*frame.classes)[i], test::LivoxPoint(i).line);
}

TEST_F(CloudMessages, OfALivoxCountAsCloudsWhereTopicsAreChosen) {
  const Bytes livox = test::livox_message(Encoding::cdr, kPoints);
  record({{msg::CustomMsg::ros_type, livox}, {msg::CustomMsg::old_ros_type, livox}});
  try {
    open_source(file(), as_recorded());
    FAIL() << "opened";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "several topics have clouds: /0, /1; choose one with --topic");
  }
}

TEST_F(CloudMessages, CutOnesAreErrorsOfTheirFrame) {
  Bytes cut = test::livox_message(Encoding::cdr, kPoints);
  cut.pop_back();
  record({{msg::CustomMsg::ros_type, cut}});
  const auto source = open_source(file(), as_recorded());
  Frame frame;
  EXPECT_THROW(source->next(frame, 1000ms), FrameError);
  EXPECT_EQ(source->next(frame, 1000ms), Next::end);
  EXPECT_THROW(RecordedClouds(file(), "").load(0), MessageError);
}

TEST_F(CloudMessages, OfALivoxInABagOfRosAreTheSame) {
  const std::string bag = (path_ / "a.bag").string();
  const std::string python = "/usr/bin/python3 ";  // Debian's, which has its modules
  if (std::system((python + "-c 'import rosbag, genpy.dynamic' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "python3-rosbag is not installed";
  ASSERT_EQ(std::system((python + PCL_BV_WRITE_CLOUDS_BAG " " + bag + " " + std::to_string(kPoints)).c_str()),
            0);
  const auto source = open_source(bag, as_recorded());
  Frame frame;
  for (std::int64_t k = 0; k < 3; ++k) {
    ASSERT_EQ(source->next(frame, 1000ms), Next::frame);
    EXPECT_EQ(frame.header.stamp_ns, (5 + k) * 1'000'000'000 + 6);
    expect_livox(frame);
  }
  EXPECT_EQ(source->next(frame, 1000ms), Next::end);
}

TEST(LiveCloudMessages, OfALivoxAreReadWhereTheyLie) {
  const Bytes bytes = test::livox_message(Encoding::cdr, kPoints);
  const auto source = make_message_source(
      std::make_unique<OneMessage>(number_of(msg::CustomMsg::old_ros_type), bytes), "dds:/livox");
  Frame frame;
  ASSERT_EQ(source->next(frame, 0ms), Next::frame);
  expect_livox(frame);
  const auto& owner = *static_cast<const Bytes*>(frame.owner.get());
  EXPECT_GE(frame.points.data, owner.data());
  EXPECT_LT(frame.points.data, owner.data() + owner.size());
}

TEST(CloudTypes, ArePointCloud2FirstAndNothingElseByOtherNames) {
  EXPECT_EQ(cloud_type_names().front(), msg::PointCloud2::ros_type);
  for (const std::string& name : cloud_type_names())
    EXPECT_TRUE(cloud_type_of(name)) << name;
  for (const char* name :
       {"", "sensor_msgs/msg/Image", "livox_ros_driver2/CustomMsg", "sensor_msgs/msg/PointCloud"})
    EXPECT_FALSE(cloud_type_of(name)) << name;
}

}  // namespace
}  // namespace pcl_bv::detail
