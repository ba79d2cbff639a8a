// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Frames from the messages of a middleware, which here is a list.

#include "stream/sources/message_source.h"

#include <gmock/gmock.h>

#include <deque>

#include "folder.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/serialize.h"
#include "stream/middleware.h"

namespace pcl_bv::detail {
namespace {

using Bytes = std::vector<std::byte>;
using namespace std::chrono_literals;

class List final : public MessageReceiver {
 public:
  explicit List(std::deque<Bytes> messages) : messages_(std::move(messages)) {}
  bool next(ReceivedMessage& message, std::chrono::milliseconds) override {
    if (messages_.empty()) return false;
    const auto bytes = std::make_shared<Bytes>(std::move(messages_.front()));
    messages_.pop_front();
    message = {bytes->data(), bytes->size(), bytes, 77};
    return true;
  }
  std::vector<std::string> take_warnings() override { return {"3 lost on the way"}; }

 private:
  std::deque<Bytes> messages_;
};

Bytes cloud_at(std::int32_t seconds, const std::vector<float>& xyz) {
  msg::PointCloud2 cloud;
  cloud.header.stamp.sec = seconds;
  cloud.header.frame_id = "lidar";
  for (const char* name : {"x", "y", "z"})
    cloud.fields.push_back(
        {name, static_cast<std::uint32_t>(4 * cloud.fields.size()), msg::PointField::FLOAT32, 1});
  cloud.point_step = 12;
  cloud.width = static_cast<std::uint32_t>(xyz.size() / 3);
  cloud.row_step = 12 * cloud.width;
  cloud.data = {reinterpret_cast<const std::byte*>(xyz.data()), 4 * xyz.size()};
  Bytes bytes;
  write_cdr(cloud, bytes);
  return bytes;
}

std::unique_ptr<FrameSource> vector_source(std::deque<Bytes> messages, const ReplayOptions& options = {}) {
  return make_message_source(std::make_unique<List>(std::move(messages)), "dds:/points", options);
}

TEST(MessageSource, GivesTheCloudWhereItLies) {
  const auto source = vector_source({cloud_at(5, {1, 2, 3, 4, 5, 6})});
  Frame frame;
  ASSERT_EQ(source->next(frame, 0ms), Next::frame);
  EXPECT_EQ(frame.header.stamp_ns, 5'000'000'000);
  EXPECT_EQ(frame.header.frame_id, "lidar");
  EXPECT_EQ(frame.file, "dds:/points");
  ASSERT_EQ(frame.points.count, 2U);
  const auto* const bytes = static_cast<const Bytes*>(frame.owner.get());
  EXPECT_GE(static_cast<const void*>(frame.points.data), static_cast<const void*>(bytes->data()));
  EXPECT_LT(static_cast<const void*>(frame.points.data),
            static_cast<const void*>(bytes->data() + bytes->size()));
  EXPECT_NE(frame.taken, std::chrono::steady_clock::time_point());
  EXPECT_EQ(source->next(frame, 0ms), Next::timeout);
  EXPECT_THAT(source->take_warnings(), testing::ElementsAre("3 lost on the way"));
}

std::vector<std::int64_t> stamps_of(FrameSource& source) {
  std::vector<std::int64_t> stamps;
  for (Frame frame; source.next(frame, 0ms) == Next::frame;)
    stamps.push_back(frame.header.stamp_ns);
  return stamps;
}

// A folder of clouds begins at 0, and so may a simulation.
TEST(MessageSource, AStampOfZeroIsAStamp) {
  const auto source = vector_source({cloud_at(0, {1, 2, 3}), cloud_at(1, {1, 2, 3}), cloud_at(0, {1, 2, 3})});
  EXPECT_THAT(stamps_of(*source), testing::ElementsAre(0, 1'000'000'000, 0));
  EXPECT_THAT(source->take_warnings(), testing::ElementsAre("3 lost on the way"));
}

TEST(MessageSource, HasTheTimesOfSendingWhereADriverWritesNoStamps) {
  const Bytes none = cloud_at(0, {1, 2, 3});
  const auto source = vector_source({none, none, none, cloud_at(5, {1, 2, 3}), none});
  EXPECT_THAT(stamps_of(*source), testing::ElementsAre(0, 77, 77, 5'000'000'000, 0));
  EXPECT_THAT(
      source->take_warnings(),
      testing::ElementsAre("3 lost on the way",
                           "the clouds have no stamps (all are 0): their times of sending or recording "
                           "are used instead"));
}

TEST(MessageSource, GoesOnAfterWhatIsNoCloud) {
  Bytes cut = cloud_at(1, {1, 2, 3});
  cut.resize(cut.size() - 6);
  const auto source = vector_source({cut, {}, cloud_at(2, {1, 2, 3})});
  Frame frame;
  for (std::uint64_t number = 0; number < 2; ++number) {
    try {
      source->next(frame, 0ms);
      FAIL() << "read";
    } catch (const FrameError& error) {
      EXPECT_EQ(error.frame.header.seq, number);
      EXPECT_EQ(error.frame.file, "dds:/points");
    }
  }
  ASSERT_EQ(source->next(frame, 0ms), Next::frame);
  EXPECT_EQ(frame.header.seq, 2U);
}

class MessageSourceWithPoses : public Folder {};

TEST_F(MessageSourceWithPoses, TakesThemByTimeOnly) {
  const auto with_poses = [&](const char* name, const char* text) {
    write(name, text);
    ReplayOptions options;
    options.frame_id = "roof";
    options.poses = path_ / name;
    return options;
  };
  const auto source =
      vector_source({cloud_at(5, {1, 2, 3})}, with_poses("tum", "4.9 0 0 0 0 0 0 1\n5.1 2 0 0 0 0 0 1\n"));
  Frame frame;
  ASSERT_EQ(source->next(frame, 0ms), Next::frame);
  ASSERT_TRUE(frame.pose);
  EXPECT_DOUBLE_EQ(frame.pose->translation().x(), 1);
  EXPECT_EQ(frame.header.frame_id, "roof");
  EXPECT_THROW(vector_source({}, with_poses("kitti", "1 0 0 0 0 1 0 0 0 0 1 0\n")), IoError);
  EXPECT_THROW(make_message_source(nullptr, "none"), std::invalid_argument);
}

TEST(Middlewares, SayWhatIsNotInstalled) {
  try {
    middleware("carrier_pigeon");
    FAIL() << "loaded";
  } catch (const IoError& error) {
    EXPECT_STREQ(error.what(),
                 "pcl_bv_carrier_pigeon.so is not installed; it belongs to the component `carrier_pigeon`");
  }
}

}  // namespace
}  // namespace pcl_bv::detail
