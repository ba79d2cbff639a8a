// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_source.h"

#include <gtest/gtest.h>
#include <fstream>
#include <future>

#include "folder.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/synth/rural_road.h"

namespace pcl_bv::detail {
namespace {

using FolderSource = Folder;

constexpr std::chrono::milliseconds kPatience{20'000};

bool next(FrameSource& source, Frame& frame) {
  const Next next = source.next(frame, kPatience);
  EXPECT_NE(next, Next::timeout);
  return next == Next::frame;
}

TEST(StampInName, ReadsTimesAndNoFrameNumbers) {
  EXPECT_EQ(stamp_in_name("1317384506400000000"), 1'317'384'506'400'000'000);
  EXPECT_EQ(stamp_in_name("n015__LIDAR_TOP__1532402927647951.pcd"), 1'532'402'927'647'951'000);
  EXPECT_EQ(stamp_in_name("1317384506.25"), 1'317'384'506'250'000'000);
  EXPECT_EQ(stamp_in_name("lidar-12.000000001"), 12'000'000'001);
  EXPECT_EQ(stamp_in_name("12.1234567899"), 12'123'456'789);
  EXPECT_EQ(stamp_in_name("a.1317384506400000000"), 1'317'384'506'400'000'000);
  EXPECT_EQ(stamp_in_name("1000000000000000"), 1'000'000'000'000'000'000);
  EXPECT_EQ(stamp_in_name("10000000000000000"), 10'000'000'000'000'000);
  for (const char* number : {"000000", "sweep_000012", "a.5", "999999999999999"})
    EXPECT_EQ(stamp_in_name(number), -1) << number;
  EXPECT_EQ(stamp_in_name("sweep"), -1);
  EXPECT_EQ(stamp_in_name(""), -1);
  EXPECT_EQ(stamp_in_name("99999999999999999999"), -1);
  EXPECT_EQ(stamp_in_name("99999999999.5"), -1);
  EXPECT_EQ(stamp_in_name("9223372036853"), 9'223'372'036'853'000'000);  // milliseconds: the year 2262
  EXPECT_EQ(stamp_in_name("9223372036854774"), 9'223'372'036'854'774'000);
  for (const char* later : {"9223372036855", "9999999999999", "9223372036854776", "9999999999999999"})
    EXPECT_EQ(stamp_in_name(later), -1) << later;
}

// 2012-12-14T14:22:59 and 2024-03-21T12:59:59, UTC.
constexpr std::int64_t k2012 = 1'355'494'979'000'000'000, k2024 = 1'711'025'999'000'000'000;

TEST(StampInName, ReadsDatesWithTimes) {
  for (const char* name : {"frame_20121214T142259.814212", "20121214_142259.814212", "20121214-142259-814212",
                           "20121214142259814212", "2012-12-14T14-22-59.814212", "2012_12_14_14_22_59_814212",
                           "cloud 2012-12-14 14:22:59,814212Z", "2012.12.14T14.22.59.814212",
                           "2012-12-14T15:22:59.814212+01:00", "2012-12-14-22-22-59-814212000+0800"})
    EXPECT_EQ(stamp_in_name(name), k2012 + 814'212'000) << name;
  EXPECT_EQ(stamp_in_name("2024-03-21-12-59-59_0"), k2024);
  EXPECT_EQ(stamp_in_name("20240321125959"), k2024);
  EXPECT_EQ(stamp_in_name("2024-02-29T00-00-00"), stamp_in_name("2024-02-28T23-59-59") + 1'000'000'000);
  EXPECT_EQ(stamp_in_name("2023-02-29T00-00-01"), 1'000'000'000);  // no such day: of a day
  EXPECT_EQ(stamp_in_name("2024-03-21T24-00-00"), -1);
  EXPECT_EQ(stamp_in_name("2024-03-21_cloud7"), -1);
  EXPECT_EQ(stamp_in_name("12-59-59.9"), 46'799'900'000'000);  // of a day
}

TEST(StampInName, TakesTheSurestOfSeveralNumbers) {
  EXPECT_EQ(stamp_in_name("n015-2018-07-24-11-22-45+0800__LIDAR_TOP__1532402927647951"),
            1'532'402'927'647'951'000);
  EXPECT_EQ(stamp_in_name("1532402927647951_cam0"), 1'532'402'927'647'951'000);
  EXPECT_EQ(stamp_in_name("1317384506.25_part_3"), 1'317'384'506'250'000'000);
  EXPECT_EQ(stamp_in_name("1317384506_250000000"), 1'317'384'506'250'000'000);
  EXPECT_EQ(stamp_in_name("1317384506250"), 1'317'384'506'250'000'000);
  EXPECT_EQ(stamp_in_name("1317384506"), 1'317'384'506'000'000'000);
}

class NamedFrames : public Folder {
 protected:
  struct Read {
    std::vector<std::int64_t> stamps;
    std::vector<std::string> remarks;
  };
  Read read_names(const std::vector<std::string>& names) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
    for (const std::string& name : names)
      write(name + ".pcd",
            "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
            "POINTS 1\nDATA ascii\n1 2 3\n");
    ReplayOptions options;
    options.own_stamps = true;
    const auto source = open_source(path_.string(), options);
    Read read;
    for (Frame frame; next(*source, frame);)
      read.stamps.push_back(frame.header.stamp_ns);
    read.remarks = source->take_warnings();
    return read;
  }
  void expect_steps(const std::vector<std::string>& names, const std::vector<std::int64_t>& steps) {
    const Read read = read_names(names);
    ASSERT_EQ(read.stamps.size(), steps.size() + 1) << names.front();
    for (std::size_t i = 0; i < steps.size(); ++i)
      EXPECT_EQ(read.stamps[i + 1] - read.stamps[i], steps[i]) << names.front() << ", " << i;
    EXPECT_THAT(read.remarks, testing::IsEmpty()) << names.front();
  }
};

TEST_F(NamedFrames, WithTimesOfDayAscendOverMinutesAndDays) {
  expect_steps({"frame_20121214T142259.814212", "frame_20121214T142300.068683"}, {254'471'000});
  for (const auto& [before, after] : std::vector<std::pair<std::string, std::string>>{
           {"frame_20121214T235959.900000", "frame_20121215T000000.100000"},
           {"2024-03-21T12-59-59.900", "2024-03-21T13-00-00.100"},
           {"2024-02-28T23-59-59.900Z", "2024-02-29T00-00-00.100Z"},
           {"2023-12-31_23-59-59-900", "2024-01-01_00-00-00-100"},
           {"20240331_235959_900000", "20240401_000000_100000"},
           {"13-59-59.900", "14-00-00.100"}})
    expect_steps({before, after}, {200'000'000});
}

TEST_F(NamedFrames, WithFractionsWithoutLeadingZerosAreWholeNanoseconds) {
  const auto stamps =
      read_names({"899.11149430", "899.99999999", "899.199999999", "899.299999999", "900.5000000"}).stamps;
  EXPECT_EQ(stamps, (std::vector<std::int64_t>{899'011'149'430, 899'099'999'999, 899'199'999'999,
                                               899'299'999'999, 900'005'000'000}));
  expect_steps({"7.50", "7.150", "7.250", "8.50"}, {100'000'000, 100'000'000, 800'000'000});  // milliseconds
  expect_steps({"a_1317384506.90000", "a_1317384506.190000"}, {100'000'000});                 // microseconds
  expect_steps({"20240321T125959.90000", "20240321T125959.190000"}, {100'000'000});
}

// Natural order has 12.5 before 12.25.
TEST_F(NamedFrames, WithShortDecimalsComeInTheOrderOfTheirTimes) {
  const Read read = read_names({"12.0", "12.25", "12.5", "12.75", "13.0"});
  EXPECT_EQ(read.stamps, (std::vector<std::int64_t>{12'000'000'000, 12'250'000'000, 12'500'000'000,
                                                    12'750'000'000, 13'000'000'000}));
  EXPECT_THAT(read.remarks, testing::ElementsAre(testing::HasSubstr("sorted by the times in their names")));
}

TEST_F(NamedFrames, SayThatTheirTimesDoNotAscend) {
  for (const auto& names :
       std::vector<std::vector<std::string>>{{"a_1317384506.250", "b_1317384506.250"},
                                             {"a_1317384507.250", "b_1317384506.250"},
                                             {"0_2024-03-21T12-59-59", "1_2024-03-21T12-59-59"}}) {
    const Read read = read_names(names);
    EXPECT_EQ(read.stamps.size(), 2U);
    EXPECT_THAT(read.remarks,
                testing::ElementsAre(testing::HasSubstr("the times in the names do not ascend")));
  }
}

// The recording's beginning and the frame's number are no time.
TEST_F(NamedFrames, WithADateAndACountHaveTheTimesThatAscend) {
  const Read read = read_names({"20240321_125959_000", "20240321_125959_001", "20240321_125959_002"});
  EXPECT_THAT(read.remarks, testing::SizeIs(1));
  expect_steps({"2018-07-24-11-22-45__1532402927647951", "2018-07-24-11-22-45__1532402927697951"},
               {50'000'000});
}

TEST_F(FolderSource, GivesItsCloudsInNaturalOrderWithTheRatesStamps) {
  add("frame10.pcd", 10);
  add("frame9.pcd", 9);
  add("frame1.pcd", 1);
  const auto source = open_source(path_, {20, false, 0, 2});
  Frame frame;
  std::vector<std::size_t> sizes;
  for (std::uint64_t seq = 0; next(*source, frame); ++seq) {
    EXPECT_EQ(frame.header.seq, seq);
    EXPECT_EQ(frame.header.stamp_ns, static_cast<std::int64_t>(seq) * 50'000'000);
    EXPECT_GT(frame.decode_ms, 0);
    sizes.push_back(frame.points.count);
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{1, 9, 10, 1, 9, 10}));
}

TEST_F(FolderSource, NamesAFrameThatCannotBeReadAndGoesOn) {
  add("1.pcd", 3);
  std::ofstream(path_ / "2.pcd") << "no cloud";
  add("3.pcd", 5);
  const auto source = open_source(path_);
  Frame frame;
  EXPECT_TRUE(next(*source, frame));
  try {
    next(*source, frame);
    FAIL();
  } catch (const FrameError& error) {
    EXPECT_EQ(error.frame.header.seq, 1U);
    EXPECT_EQ(error.frame.file, path_ / "2.pcd");
    EXPECT_EQ(std::string(error.what()), error.frame.file + ": " + error.reason);
    EXPECT_NE(std::string(error.what()).find("2.pcd: "), std::string::npos);
  }
  EXPECT_TRUE(next(*source, frame));
  EXPECT_EQ(frame.points.count, 5U);
  EXPECT_FALSE(next(*source, frame));
}

TEST_F(FolderSource, TakesStampsFromNamesIfAsked) {
  add("1000000000.5.pcd", 3);
  add("nothing.pcd", 3);
  const auto source = open_source(path_, {10, true});
  Frame frame;
  EXPECT_TRUE(next(*source, frame));
  EXPECT_EQ(frame.header.stamp_ns, 1'000'000'000'500'000'000);
  EXPECT_THROW(next(*source, frame), FrameError);
  EXPECT_FALSE(next(*source, frame));
}

TEST_F(FolderSource, RefusesStampsFromNamesThatCountFrames) {
  add("000000.pcd", 3);
  add("000001.pcd", 3);
  EXPECT_THROW(open_source(path_, {10, true}), std::invalid_argument);
  EXPECT_THROW(open_source("synth:street-sequence:1", {10, true}), std::invalid_argument);
}

TEST_F(FolderSource, NamesFilesAndTheirCoordinateFrame) {
  add("1.pcd", 3);
  ReplayOptions options;
  options.frame_id = "lidar_top";
  Frame frame;
  ASSERT_TRUE(next(*open_source(path_, options), frame));
  EXPECT_EQ(frame.header.frame_id, "lidar_top");
  EXPECT_EQ(frame.file, path_ / "1.pcd");
  EXPECT_FALSE(frame.pose);
}

TEST_F(FolderSource, WithoutACloudIsAnError) {
  EXPECT_THROW(open_source(path_), IoError);
  EXPECT_THROW(open_source(path_ / "missing"), IoError);
  EXPECT_THROW(open_source("synth:nothing"), std::invalid_argument);
  EXPECT_THROW(open_source(path_, {0, false}), std::invalid_argument);
}

TEST(SynthSource, GivesTheFramesOfTheSequence) {
  const auto source = open_source("synth:street-sequence:2:7", {10, false, 0, 2});
  Frame frame;
  std::vector<float> first;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(next(*source, frame));
    EXPECT_EQ(frame.points.count, 128'000U);
    const float x = static_cast<float>(load_point(frame.points, 90'000).x);
    if (i < 2) first.push_back(x);
    EXPECT_EQ(x, first[static_cast<std::size_t>(i) % 2]);
  }
  EXPECT_FALSE(next(*source, frame));
}

TEST(SynthSource, GivesTheRuralRoadOfSoManyBeamsAndItsPoses) {
  const auto source = open_source("synth:rural-road-sequence-16:2:7");
  for (std::size_t i = 0; i < 2; ++i) {
    Frame frame;
    ASSERT_TRUE(next(*source, frame));
    const RuralRoadFrame made = make_rural_road_frame({7, 16}, i);
    ASSERT_EQ(frame.points.count, made.cloud.size());
    EXPECT_EQ(frame.header.frame_id, "rural_road");
    for (std::size_t point = 0; point < made.cloud.size(); point += 1000)
      EXPECT_EQ(load_point(frame.points, point).x, made.cloud.xyz[3 * point]);
    ASSERT_TRUE(frame.pose);
    for (Eigen::Index k = 0; k < 12; ++k)
      EXPECT_EQ((*frame.pose)(k / 4, k % 4), made.pose[static_cast<std::size_t>(k)]);
  }
  EXPECT_THROW(open_source("synth:rural-road-sequence-17"), std::invalid_argument);
}

TEST_F(FolderSource, GivesPosesInsteadOfThoseOfTheRuralRoad) {
  write("poses.txt", "1 0 0 5 0 1 0 6 0 0 1 7\n");
  ReplayOptions options;
  options.poses = path_ / "poses.txt";
  Frame frame;
  ASSERT_TRUE(next(*open_source("synth:rural-road-sequence-16:1", options), frame));
  ASSERT_TRUE(frame.pose);
  EXPECT_EQ(frame.pose->translation(), Eigen::Vector3d(5, 6, 7));
}

TEST(FunctionSource, EndsWhenTheFunctionSaysSo) {
  int calls = 0;
  const auto source = make_source([&](Frame& frame) {
    frame.header.seq = 5;
    return ++calls < 3;
  });
  Frame frame;
  EXPECT_TRUE(next(*source, frame));
  EXPECT_EQ(frame.header.seq, 5U);
  EXPECT_TRUE(next(*source, frame));
  EXPECT_FALSE(next(*source, frame));
  EXPECT_EQ(calls, 3);
}

TEST(FunctionSource, ASilentOneIsNotWaitedFor) {
  struct Shared {
    std::promise<void> begun, speak, spoken;
    int calls = 0;
  };
  const auto shared = std::make_shared<Shared>();
  auto source = make_source([shared](Frame&) {
    if (++shared->calls < 2) return true;
    shared->begun.set_value();
    shared->speak.get_future().wait();
    shared->spoken.set_value();
    return true;
  });
  Frame frame;
  ASSERT_TRUE(next(*source, frame));
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(source->next(frame, std::chrono::milliseconds(1)), Next::timeout);
  shared->begun.get_future().wait();
  source.reset();
  shared->speak.set_value();
  shared->spoken.get_future().wait();
  EXPECT_EQ(shared->calls, 2);  // called once, however often it was asked for
}

TEST(FunctionSource, ItsExceptionsCostTheirFramesOnly) {
  int calls = 0;
  const auto source = make_source([&](Frame& frame) {
    if (++calls == 1) throw FrameError(frame, "dust");
    if (calls == 2) throw std::runtime_error("unplugged");
    return true;
  });
  Frame frame;
  EXPECT_THROW(next(*source, frame), FrameError);
  try {
    next(*source, frame);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "unplugged");
  }
  EXPECT_TRUE(next(*source, frame));
}

TEST(SourceKinds, AreListedForUsers) {
  EXPECT_EQ(source_syntax(),
            "A folder of clouds, one file\nor a recording (.mcap, .bag, .db3 or its folder)\nor packets of a "
            "Velodyne, Hesai, Livox or Ouster (.pcap, .pcapng)\nor dds:TOPIC of ROS 2 with clouds\nor "
            "synth:street-sequence[:FRAMES[:SEED]]\n"
            "or synth:rural-road-sequence[-BEAMS][:FRAMES[:SEED]]");
}

}  // namespace
}  // namespace pcl_bv::detail
