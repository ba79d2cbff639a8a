// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <functional>

#include "folder.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/messages/odometry.h"
#include "pcl_bv/messages/schema.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/recording/mcap_writer.h"
#include "stream/rig/transform_feed.h"
#include "stream/sources/recorded_clouds.h"
#include "stream/sources/sources.h"

namespace pcl_bv::detail {
namespace {

// Points (i, number, 0) with a class of 7 each.
msg::PointCloud2 cloud_of(std::size_t number, std::vector<std::byte>& bytes) {
  msg::PointCloud2 cloud;
  cloud.header = {msg::time_of(static_cast<std::int64_t>(number) * 50'000'000 + 1'000'000'000), "velodyne"};
  cloud.width = static_cast<std::uint32_t>(number + 1);
  cloud.point_step = 14;
  cloud.fields = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"class", 12, 4, 1}};
  bytes.assign(std::size_t{14} * cloud.width, std::byte{0});
  for (std::size_t i = 0; i < cloud.width; ++i) {
    const float xyz[] = {static_cast<float>(i), static_cast<float>(number), 0};
    std::memcpy(bytes.data() + 14 * i, xyz, sizeof xyz);
    bytes[14 * i + 12] = std::byte{7};
  }
  cloud.data = {bytes.data(), bytes.size()};
  return cloud;
}

class RecordedSource : public Folder {
 protected:
  std::string file() const { return (path_ / "a.mcap").string(); }

  // `clouds` of each of these topics, and one topic of something else.
  void record(const std::vector<std::string>& topics, std::size_t clouds = 3,
              const std::function<void(std::size_t, msg::PointCloud2&)>& spoil = {}) {
    McapWriter writer(file(), {Compression::zstd, 1});
    writer.add_topic({"/tf", msg::TFMessage::ros_type, schema_of(msg::TFMessage::ros_type), {}});
    std::vector<std::byte> data, bytes;
    for (const std::string& topic : topics)
      writer.add_topic({topic, msg::PointCloud2::ros_type, schema_of(msg::PointCloud2::ros_type), {}});
    for (std::size_t i = 0; i < clouds; ++i) {
      msg::PointCloud2 cloud = cloud_of(i, data);
      if (spoil) spoil(i, cloud);
      bytes.clear();
      write_cdr(cloud, bytes);
      for (std::size_t t = 0; t < topics.size(); ++t)
        writer.write(t + 1, 77'000'000 + static_cast<std::int64_t>(i), 0, bytes.data(), bytes.size());
    }
    writer.close();
  }

  std::string refusal(const ReplayOptions& options) const {
    try {
      open_source(file(), options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    } catch (const IoError& error) {
      return std::string("unreadable: ") + error.what();
    }
    return "none";
  }
};

ReplayOptions as_recorded() {
  ReplayOptions options;
  options.own_stamps = true;
  return options;
}

std::vector<Frame> frames_of(FrameSource& source) {
  std::vector<Frame> frames;
  for (Frame frame; source.next(frame, std::chrono::milliseconds(1000)) == Next::frame;)
    frames.push_back(frame);
  return frames;
}

TEST_F(RecordedSource, GivesCloudsWithTheirOwnTimesAndFrames) {
  record({"/points"});
  const auto source = open_source(file(), as_recorded());
  const std::vector<Frame> frames = frames_of(*source);
  ASSERT_EQ(frames.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(frames[i].header.seq, i);
    EXPECT_EQ(frames[i].header.stamp_ns, static_cast<std::int64_t>(i) * 50'000'000 + 1'000'000'000);
    EXPECT_EQ(frames[i].header.frame_id, "velodyne");
    ASSERT_EQ(frames[i].points.count, i + 1);
    EXPECT_EQ(load_point(frames[i].points, i).x, static_cast<double>(i));
    EXPECT_EQ(load_point(frames[i].points, i).y, static_cast<double>(i));
    EXPECT_EQ(frames[i].file, file());
  }
  EXPECT_THAT(source->take_warnings(), testing::IsEmpty());
}

TEST_F(RecordedSource, GivesTheTimesOfTheRateWhereTheyAreAskedFor) {
  record({"/points"});
  ReplayOptions options;
  options.rate_hz = 4;
  options.frame_id = "roof";
  options.loops = 2;
  const std::vector<Frame> frames = frames_of(*open_source(file(), options));
  ASSERT_EQ(frames.size(), 6U);
  EXPECT_EQ(frames[5].header.stamp_ns, 1'250'000'000);
  EXPECT_EQ(frames[5].header.frame_id, "roof");
  EXPECT_EQ(frames[5].points.count, 3U);
}

TEST_F(RecordedSource, WithoutAStampTakesWhenItWasRecorded) {
  record({"/points"}, 1, [](std::size_t, msg::PointCloud2& cloud) { cloud.header.stamp = {}; });
  EXPECT_EQ(frames_of(*open_source(file(), as_recorded()))[0].header.stamp_ns, 77'000'000);
}

TEST_F(RecordedSource, AStampOfZeroIsAStampIfTheNextOneIsNotZero) {
  record({"/points"}, 3, [](std::size_t i, msg::PointCloud2& cloud) {
    cloud.header.stamp = msg::time_of(static_cast<std::int64_t>(i) * 100'000'000);
  });
  const auto source = open_source(file(), as_recorded());
  const std::vector<Frame> frames = frames_of(*source);
  ASSERT_EQ(frames.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(frames[i].header.stamp_ns, static_cast<std::int64_t>(i) * 100'000'000);
  EXPECT_THAT(source->take_warnings(), testing::IsEmpty());
}

TEST_F(RecordedSource, WithoutAnyStampTakesWhenCloudsWereRecordedAndSaysSo) {
  record({"/points"}, 3, [](std::size_t, msg::PointCloud2& cloud) { cloud.header.stamp = {}; });
  const auto source = open_source(file(), as_recorded());
  const std::vector<Frame> frames = frames_of(*source);
  ASSERT_EQ(frames.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(frames[i].header.stamp_ns, 77'000'000 + static_cast<std::int64_t>(i));
  EXPECT_THAT(source->take_warnings(), testing::ElementsAre(testing::HasSubstr("the clouds have no stamps")));
}

TEST_F(RecordedSource, NumbersItsPasses) {
  record({"/points"});
  ReplayOptions options = as_recorded();
  options.loops = 2;
  const std::vector<Frame> frames = frames_of(*open_source(file(), options));
  ASSERT_EQ(frames.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(frames[i].pass, i / 3);
}

TEST_F(RecordedSource, OfSeveralTopicsWantsOneNamed) {
  record({"/front", "/rear"});
  EXPECT_EQ(refusal({}), "several topics have clouds: /front, /rear; choose one with --topic");
  ReplayOptions options = as_recorded();
  options.topic = "/rear";
  EXPECT_EQ(frames_of(*open_source(file(), options)).size(), 3U);
  options.topic = "/left";
  EXPECT_EQ(refusal(options), "no topic /left; those with clouds: /front, /rear");
  options.topic = "/tf";
  EXPECT_EQ(refusal(options),
            "topic /tf is of tf2_msgs/msg/TFMessage (cdr), not of clouds; those with clouds: /front, /rear");
}

TEST_F(RecordedSource, NamesOfTopicsDoNotBreakTheLineOfAnError) {
  record({"/a\nb", "/c"});
  EXPECT_EQ(refusal({}), "several topics have clouds: /a?b, /c; choose one with --topic");
}

TEST_F(RecordedSource, WithoutCloudsSaysWhatIsThere) {
  record({});
  EXPECT_EQ(refusal({}),
            "unreadable: " + file() + ": no topic with clouds; topics: /tf (tf2_msgs/msg/TFMessage)");
  ReplayOptions options = as_recorded();
  options.topic = "/points";
  EXPECT_EQ(refusal(options), "no topic /points; there are /tf (tf2_msgs/msg/TFMessage)");
}

// Filters publish a default cloud when nothing is left: nothing is there, and tracks age.
TEST_F(RecordedSource, GivesAnEmptyFrameForACloudWithoutPointsAndFields) {
  record({"/points"}, 3, [](std::size_t i, msg::PointCloud2& cloud) {
    if (i != 1) return;
    const msg::Header header = cloud.header;
    cloud = msg::PointCloud2();
    cloud.header = header;
  });
  for (const char* classes : {"", "class"}) {
    ReplayOptions options = as_recorded();
    options.class_field = classes;
    const std::vector<Frame> frames = frames_of(*open_source(file(), options));
    ASSERT_EQ(frames.size(), 3U);
    EXPECT_EQ(frames[1].points.count, 0U);
    EXPECT_EQ(frames[1].header.stamp_ns, 1'050'000'000);
    EXPECT_EQ(frames[1].classes != nullptr, *classes != '\0');
  }
  RecordedClouds clouds(file(), "");
  EXPECT_EQ(clouds.count(), 3U);
  EXPECT_EQ(clouds.load(1).size(), 0U);
}

TEST_F(RecordedSource, SaysTheSameOfAFieldThatCannotBeReadHoweverItIsRead) {
  record({"/points"}, 1, [](std::size_t, msg::PointCloud2& cloud) { cloud.fields[3].datatype = 9; });
  const std::vector<Frame> frames = frames_of(*open_source(file(), as_recorded()));
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].note, "field 'class' is left out: it is of datatype 9, not 1 to 8");
  EXPECT_EQ(RecordedClouds(file(), "").load(0).note, frames[0].note);
}

TEST_F(RecordedSource, KnowsWhenItsCloudsWereRecorded) {
  record({"/points"});
  const std::vector<Frame> frames = frames_of(*open_source(file(), as_recorded()));
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[2].recorded_ns, 77'000'002);
}

TEST_F(RecordedSource, GoesOnAfterACloudThatDoesNotFitItsData) {
  record({"/points"}, 3, [](std::size_t i, msg::PointCloud2& cloud) {
    if (i == 1) cloud.width = 99;
  });
  const auto source = open_source(file(), as_recorded());
  Frame frame;
  const std::chrono::milliseconds timeout(1000);
  EXPECT_EQ(source->next(frame, timeout), Next::frame);
  try {
    source->next(frame, timeout);
    FAIL();
  } catch (const FrameError& error) {
    EXPECT_EQ(error.reason, "the cloud should have 99 x 1 points of 14 bytes, but has only 28 bytes");
    EXPECT_EQ(error.frame.header.seq, 1U);
  }
  EXPECT_EQ(source->next(frame, timeout), Next::frame);
  EXPECT_EQ(frame.points.count, 3U);
  EXPECT_EQ(source->next(frame, timeout), Next::end);
}

TEST_F(RecordedSource, ReadsClasses) {
  record({"/points"});
  ReplayOptions options = as_recorded();
  options.class_field = "class";
  const std::vector<Frame> frames = frames_of(*open_source(file(), options));
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(*frames[1].classes, (std::vector<std::int64_t>{7, 7}));
}

TEST_F(RecordedSource, TakesPosesByFrame) {
  record({"/points"});
  write("two.txt", "1 0 0 5 0 1 0 0 0 0 1 0\n1 0 0 6 0 1 0 0 0 0 1 0\n");
  write("three.txt", "1 0 0 5 0 1 0 0 0 0 1 0\n1 0 0 6 0 1 0 0 0 0 1 0\n1 0 0 7 0 1 0 0 0 0 1 0\n");
  ReplayOptions options = as_recorded();
  options.poses = path_ / "three.txt";
  const std::vector<Frame> frames = frames_of(*open_source(file(), options));
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[2].pose->translation().x(), 7);
  options.poses = path_ / "two.txt";
  EXPECT_THAT(refusal(options), testing::StartsWith("unreadable: "));
}

TEST_F(RecordedSource, SaysWhatIsDamaged) {
  record({"/points"}, 5);
  std::string bytes = read("a.mcap");
  bytes.resize(bytes.size() - 10);
  write("a.mcap", bytes);
  const auto source = open_source(file(), as_recorded());
  EXPECT_EQ(frames_of(*source).size(), 5U);
  EXPECT_THAT(source->take_warnings(),
              testing::ElementsAre("no usable index (the file is truncated): the whole file was scanned"));
  EXPECT_TRUE(source->take_warnings().empty());
}

TEST_F(RecordedSource, CloudsThatWerePassedOverAreNotReadAgain) {
  record({"/points"}, 40);
  RecordedClouds clouds(file(), "");
  ASSERT_EQ(clouds.count(), 40U);
  clouds.load(9);
  std::filesystem::resize_file(file(), 0);  // what is read again fails
  for (const std::size_t number : {8U, 2U, 7U, 0U})
    EXPECT_EQ(clouds.load(number).width, number + 1);
  EXPECT_THROW(clouds.load(8), IoError);  // given out once
}

TEST_F(RecordedSource, ANoteIsThatOfTheFirstCloudThatHasItInWhateverOrderTheyAreLoaded) {
  record({"/points"}, 6, [](std::size_t i, msg::PointCloud2& cloud) {
    if (i > 0) cloud.fields[3].datatype = i < 4 ? 9 : 10;
  });
  for (const std::vector<std::size_t>& order :
       {std::vector<std::size_t>{0, 1, 2, 3, 4, 5}, {5, 4, 3, 2, 1, 0}, {1, 0, 2, 4, 3, 5}}) {
    RecordedClouds clouds(file(), "");
    std::vector<std::size_t> with_note;
    for (const std::size_t number : order) {
      EXPECT_EQ(clouds.load(number).note.empty(), number == 0);
      if (!clouds.new_note(number).empty()) with_note.push_back(number);
    }
    EXPECT_THAT(with_note, testing::UnorderedElementsAre(1, 4));
  }
}

TEST_F(RecordedSource, RemarksAreTakenOnce) {
  record({"/points"}, 20);
  const auto size = std::filesystem::file_size(file());
  std::fstream damaged(file(), std::ios::in | std::ios::out | std::ios::binary);
  damaged.seekp(static_cast<std::streamoff>(size / 3));
  damaged << std::string(40, '\x55');
  damaged.close();
  RecordedClouds clouds(file(), "");
  std::vector<std::string> remarks;
  std::size_t read = 0;
  try {
    for (; read < 20; ++read) {
      clouds.load(read);
      for (const std::string& remark : clouds.take_warnings())
        remarks.push_back(remark);
    }
  } catch (const IoError&) {
    for (const std::string& remark : clouds.take_warnings())
      remarks.push_back(remark);
  }
  EXPECT_LT(read, 20U);
  EXPECT_FALSE(remarks.empty());
  EXPECT_EQ(clouds.warnings(), remarks);
  EXPECT_THAT(clouds.take_warnings(), testing::IsEmpty());
}

std::string error_of(const std::function<void()>& what) {
  try {
    what();
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST_F(RecordedSource, AReaderOfCloudsSaysWhatReadsRecordings) {
  record({"/points"}, 1);
  EXPECT_EQ(error_of([&] { read_cloud(file()); }),
            "is a recording, not a cloud: read it with open_recording() or RecordedClouds");
  EXPECT_EQ(error_of([&] { check_recording_content(file()); }), "");
  write("false.mcap", "no recording");
  EXPECT_THAT(error_of([&] { check_recording_content(path_ / "false.mcap"); }),
              testing::StartsWith("is no recording that can be read: it does not begin as MCAP"));
  write("empty.bag", "");
  EXPECT_THAT(error_of([&] { check_recording_content(path_ / "empty.bag"); }), testing::HasSubstr("empty"));
  EXPECT_EQ(error_of([&] { check_recording_content(path_ / "gone.pcd"); }), "");
}

// An index may say fewer clouds than there are: poses are asked for beyond their end.
TEST_F(RecordedSource, ACloudBeyondTheNumberedPosesHasNone) {
  const std::filesystem::path poses = path_ / "poses.txt";
  std::ofstream(poses) << "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 5 0 1 0 0 0 0 1 0\n";
  const Poses two(poses, 2);
  EXPECT_TRUE(two.at(1, 0).has_value());
  EXPECT_FALSE(two.at(2, 0).has_value());
  EXPECT_FALSE(two.at(std::size_t{1} << 60U, 0).has_value());
}

// A recording with two topics of odometry, /a (the robot is at x = 1) and /b (x = 2), and /tf (x = 3) or not.
class RecordedTransformsTest : public Folder {
 protected:
  std::string record(bool with_tf) const {
    const std::string file = (path_ / (with_tf ? "tf.mcap" : "odometry.mcap")).string();
    McapWriter writer(file);
    msg::Odometry odometry;
    odometry.header.frame_id = "odom";
    odometry.child_frame_id = "base";
    odometry.pose.pose.orientation.w = 1;
    for (const char* topic : {"/a", "/b"}) {
      odometry.pose.pose.position.x += 1;
      write(writer, topic, odometry);
    }
    if (with_tf) write(writer, "/tf", transform(3));
    writer.close();
    return file;
  }

  // Records a transform in each topic: the robot is at x = 1 in the first one, 2 in the second one, ...
  std::string record_transforms(const std::vector<std::string>& topics) const {
    const std::string file = (path_ / "transforms.mcap").string();
    McapWriter writer(file);
    for (std::size_t i = 0; i < topics.size(); ++i)
      write(writer, topics[i], transform(static_cast<double>(i + 1)));
    writer.close();
    return file;
  }

  // Records a transform at each of these seconds: the robot is at x = 1 at the first one, 2 at the second
  // one, ...
  std::string record_at(const std::vector<std::int64_t>& seconds) const {
    const std::string file = (path_ / "times.mcap").string();
    McapWriter writer(file);
    for (std::size_t i = 0; i < seconds.size(); ++i)
      write(writer, "/tf", transform(static_cast<double>(i + 1), seconds[i] * 1'000'000'000),
            seconds[i] * 1'000'000'000);
    writer.close();
    return file;
  }

  static double x_of(const std::string& recording, const std::string& odometry) {
    Transforms transforms;
    recorded_transforms(recording, odometry)->read(0, transforms);
    const FoundTransform found = transforms.find("odom", "base", 0);
    return found.pose ? found.pose->translation().x() : -1;
  }

 private:
  static msg::TFMessage transform(double x, std::int64_t stamp_ns = 0) {
    msg::TransformStamped step;
    step.header.stamp = msg::time_of(stamp_ns);
    step.header.frame_id = "odom";
    step.child_frame_id = "base";
    step.transform.translation.x = x;
    return {{step}};
  }

  template <class Message>
  static void write(McapWriter& writer, const std::string& topic, const Message& message,
                    std::int64_t time = 0) {
    std::vector<std::byte> bytes;
    write_cdr(message, bytes);
    const std::size_t number = writer.add_topic({topic, Message::ros_type, "", {}});
    writer.write(number, time, time, bytes.data(), bytes.size());
  }
};

TEST_F(RecordedTransformsTest, AreThoseOfTfUnlessATopicOfOdometryIsNamed) {
  const std::string recording = record(true);
  EXPECT_EQ(x_of(recording, ""), 3);
  EXPECT_EQ(x_of(recording, "/a"), 1);
  EXPECT_EQ(x_of(recording, "/b"), 2);
  EXPECT_EQ(x_of(recording, "/c"), 3);
}

TEST_F(RecordedTransformsTest, AreThoseOfOneRobotOfSeveral) {
  const std::string robots = record_transforms({"/robot2/tf", "/robot1/tf", "/robot1/old_tf"});
  EXPECT_EQ(x_of(robots, ""), 2);
  EXPECT_THAT(recorded_transforms(robots, "")->take_warnings(),
              testing::ElementsAre("transforms of /robot1/tf are used, those of /robot2/tf are not"));
  const std::string with_root = record_transforms({"/robot1/tf", "/tf", "/robot2/tf_static"});
  EXPECT_EQ(x_of(with_root, ""), 2);
  EXPECT_THAT(recorded_transforms(with_root, "")->take_warnings(), testing::IsEmpty());
}

TEST_F(RecordedTransformsTest, ErrorsNameTheFile) {
  const std::string file = (path_ / "damaged.db3").string();
  std::ofstream(file, std::ios::binary) << std::string("SQLite format 3\0", 16) << std::string(1000, 'x');
  const auto error_of_opening = [&]() -> std::string {
    try {
      recorded_transforms(file, "");
    } catch (const IoError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(error_of_opening(), testing::StartsWith(file + ": "));
}

TEST_F(RecordedTransformsTest, TolerateAnyTimeOfACloud) {
  const auto feed = recorded_transforms(record_transforms({"/tf"}), "");
  Transforms transforms;
  for (const std::int64_t time :
       {std::numeric_limits<std::int64_t>::min(), std::int64_t{0}, std::numeric_limits<std::int64_t>::max()})
    feed->read(time, transforms);
  EXPECT_TRUE(transforms.find("odom", "base", 0).pose);
}

TEST_F(RecordedTransformsTest, AreKnownOnBothSidesOfAPause) {
  const auto feed = recorded_transforms(record_at({1, 2, 60, 61}), "");
  Transforms transforms;
  for (const auto& [second, x] : {std::pair{1, 1.0}, {2, 2.0}, {60, 3.0}, {61, 4.0}, {2, 2.0}, {61, 4.0}}) {
    const std::int64_t time = second * 1'000'000'000LL;
    feed->read(time, transforms);
    const FoundTransform found = transforms.find("odom", "base", time);
    ASSERT_TRUE(found.pose) << "at " << second << " s: " << found.problem;
    EXPECT_EQ(found.pose->translation().x(), x);
  }
}

TEST_F(RecordedTransformsTest, AreThoseOfTheFirstOrTheNamedTopicOfOdometryWithoutTf) {
  const std::string recording = record(false);
  EXPECT_EQ(x_of(recording, ""), 1);
  EXPECT_EQ(x_of(recording, "/b"), 2);
  EXPECT_EQ(recorded_transforms(recording, "/c"), nullptr);
  EXPECT_THAT(recorded_odometry_topics(recording), testing::ElementsAre("/a", "/b"));
}

}  // namespace
}  // namespace pcl_bv::detail
