// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_sink.h"

#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <thread>

#include "folder.h"
#include "frames.h"
#include "german_locale.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/recording/recording.h"
#include "pcl_bv/report/meshes.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

// Two points of one cluster, one of the ground, one of none.
struct Found {
  Found() {
    xyz = std::make_shared<std::vector<float>>(std::vector<float>{1, 2, 3, 1.5F, 2, 3, 0, 0, 0, 9, 9, 9});
    frame.points = PointView::of(xyz->data(), 12, 4);
    frame.owner = xyz;
    result.clusters.indices = {1, 0};
    result.clusters.offsets = {0, 2};
    result.ground.ground = {2};
    PipelineConfig config;
    config.track.enabled = true;
    result.config = std::make_shared<PipelineConfig>(config);
    result.tracks = {TrackEntry{17, 4, {3, -2, 0}, true, {1.25, 2, 3, 0.5}}};
    result.methods = {find_method("aabb")};
    result.volumes = {Aabb({1, 2, 3}, {1.5, 2, 3})};
    result.results.resize(1);
  }
  std::shared_ptr<std::vector<float>> xyz;
  Frame frame;
  FrameResult result;
};

using FrameSinks = Folder;

TEST(LabelsOf, NameClustersGroundAndNone) {
  const Found found;
  EXPECT_EQ(labels_of(found.frame, found.result), (std::vector<std::uint32_t>{0, 0, 4294967294, 4294967295}));
  EXPECT_TRUE(labels_of(Frame(), FrameResult()).empty());
}

TEST(LabelsOf, AnIndexListMeansTheCloudsPoints) {
  Found found;
  const std::vector<std::int32_t> numbers = {5, 1};
  found.frame.points.indices = numbers.data();
  found.frame.points.count = 2;
  found.result.clusters.indices = {5, 1};
  found.result.ground.ground.clear();
  const std::uint32_t none = 4294967295;
  EXPECT_EQ(labels_of(found.frame, found.result), (std::vector<std::uint32_t>{none, 0, none, none, none, 0}));
}

TEST_F(FrameSinks, WriteTheSameOfPointsInMemoryAndOnesThatAreAskedFor) {
  const std::vector<float> xyz = street(1, 64'000)[0];
  const AskedFor source(xyz);
  std::vector<std::string> written;
  for (const PointView& points : {PointView::of(xyz.data(), 12, xyz.size() / 3), source.view()}) {
    for (const char* filter : {"", "filtered"}) {
      PipelineConfig config = whole_cloud_config();
      config.filter.range_min = *filter == 0 ? 0 : 5;
      Frame frame;
      frame.points = points;
      FrameResult result;
      FramePipeline(config).process(frame, result);
      for (const std::string name : {"labels", "vtp"}) {
        const std::string folder = (path_ / (name + std::to_string(written.size()))).string();
        make_sink(parse_sink(name + ":" + folder + (name == "vtp" ? ",points" : "")))->write(frame, result);
        written.push_back(read(folder + (name == "vtp" ? "/points000000.vtp" : "/frame000000.pcd")));
        EXPECT_GT(written.back().size(), 16 * points.count / 2);
      }
    }
  }
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_TRUE(written[i] == written[i + 4]) << i;
  EXPECT_FALSE(written[0] == written[2]);
}

TEST_F(FrameSinks, NameFilesByTheRunnersNumberWhateverTheSourceCounts) {
  Found found;
  const auto sink = make_sink(parse_sink("vtp:" + (path_ / "v").string()));
  for (const std::uint64_t number : {0, 1, 1234567}) {
    found.frame.header.number = number;
    sink->write(found.frame, found.result);
  }
  for (const char* name : {"v/frame000000.vtp", "v/frame000001.vtp", "v/frame1234567.vtp"})
    EXPECT_THAT(read(name), HasSubstr("PolyData")) << name;
}

TEST_F(FrameSinks, AnIndexIsWholeAfterEachFrame) {
  Found found;
  make_sink(parse_sink("vtp:" + path_.string()))->close();
  EXPECT_EQ(read("frames.pvd"), std::string(kPvdBegin) + std::string(kPvdEnd));
  const auto sink = make_sink(parse_sink("vtp:" + path_.string() + ",points"));
  std::string entries;
  for (int i = 0; i < 12; ++i) {
    found.frame.header.number = static_cast<std::uint64_t>(i);
    found.frame.header.stamp_ns = 1'000'000'000'000 + std::int64_t{500'000'000} * i;
    sink->write(found.frame, found.result);
    const std::string name = (i < 10 ? "00000" : "0000") + std::to_string(i) + ".vtp";
    entries += pvd_entry({0.5 * i, "frame" + name}) + pvd_entry({0.5 * i, "points" + name, 1});
    EXPECT_EQ(read("frames.pvd"), std::string(kPvdBegin) + entries + std::string(kPvdEnd));
  }
  EXPECT_THAT(read("points000003.vtp"), HasSubstr("0 0 4294967294 4294967295"));
  EXPECT_THAT(read("points000003.vtp"), HasSubstr("NumberOfPoints=\"4\" NumberOfVerts=\"1\""));
  EXPECT_THAT(read("frame000003.vtp"), HasSubstr("Name=\"track\" format=\"ascii\">\n17 17"));
}

TEST_F(FrameSinks, LinesAreWholeAfterEachFrameAndSayWhatIsLost) {
  Found found;
  const auto csv = make_sink(parse_sink("csv:" + (path_ / "a.csv").string()));
  const auto jsonl = make_sink(parse_sink("jsonl:" + (path_ / "a.jsonl").string()));
  found.frame.header.seq = 3;
  found.frame.file = "sweep \"3\".pcd";
  csv->write(found.frame, found.result);
  EXPECT_THAT(read("a.csv"),
              testing::EndsWith("\n3,0,17,0,2,aabb,1.25,2,3,0.5,0,0,,,,,,0,3,-2,0,1.25,2,3,0.5,,,,\n"));
  csv->write_lost(found.frame, "dropped, it seems");
  EXPECT_THAT(read("a.csv"),
              testing::EndsWith("\n3,0,,,,\"error: dropped, it seems\",,,,,,,,,,,,,,,,,,,,,,,\n"));
  const std::string heading = read("a.csv").substr(0, read("a.csv").find('\n'));
  EXPECT_EQ(std::count(heading.begin(), heading.end(), ','), 5 + 12 + 7 + 4);
  jsonl->write(found.frame, found.result);
  EXPECT_THAT(read("a.jsonl"), HasSubstr("\"file\":\"sweep \\\"3\\\".pcd\",\"points\""));
  EXPECT_THAT(read("a.jsonl"), HasSubstr("\"track\":17,\"age\":4,\"velocity\":[3,-2,0],\"moving\":true,"
                                         "\"pose\":[1.25,2,3,0.5],\"covariance\":[0,"));
  jsonl->write_lost(found.frame, "dropped: age");
  EXPECT_THAT(read("a.jsonl"), testing::EndsWith(".pcd\",\"error\":\"dropped: age\"}\n"));
}

TEST_F(FrameSinks, LabelsStandBesideTheCoordinatesInTheirOwnType) {
  Found found;
  const auto sink = make_sink(parse_sink("labels:" + path_.string()));
  sink->write(found.frame, found.result);
  const std::vector<double> doubles(found.xyz->begin(), found.xyz->end());
  found.frame.points = PointView::of(doubles.data(), 24, 4);
  found.frame.header.number = 1;
  sink->write(found.frame, found.result);
  for (const char* name : {"frame000000.pcd", "frame000001.pcd"}) {
    const RawCloud cloud = read_pcd(path_ / name);
    ASSERT_EQ(cloud.size(), 4U);
    EXPECT_EQ(find_field(cloud, "x")->size, name == std::string("frame000000.pcd") ? 4U : 8U);
    std::uint32_t label = 0;
    std::memcpy(&label, cloud.data.data() + 2 * cloud.point_step + find_field(cloud, "label")->offset, 4);
    EXPECT_EQ(label, 4294967294);
    EXPECT_EQ(load_point(cloud.xyz(), 1).x, 1.5);
  }
}

TEST_F(FrameSinks, PicturesAreFilesOfTheirFrames) {
  const Found found;
  make_sink(parse_sink("image:" + path_.string()))->write(found.frame, found.result);
  EXPECT_THAT(read("frame000000.png"), testing::StartsWith("\x89PNG"));
}

// A topic with the number of its messages, of one frame and the end of the stream.
using TopicSizes = std::map<std::string, std::uint64_t>;

TopicSizes topics_of(const std::string& path) {
  TopicSizes sizes;
  const auto reader = open_recording(path);
  for (const RecordedTopic& topic : reader->topics())
    sizes[topic.name] = 0;
  RecordedMessage message;
  while (reader->next(message))
    ++sizes[reader->topics()[message.topic].name];
  return sizes;
}

TEST_F(FrameSinks, RecordingsHaveTheMessagesOfTheirOptions) {
  const TopicSizes always{{"/bv/objects", 1}, {"/bv/markers", 1}, {"/bv/scene", 1}, {"/diagnostics", 1}};
  const std::map<std::string, TopicSizes> added{
      {",moveit", {{"/bv/planning_scene", 2}, {"/bv/collision_object", 2}}},  // and removed at the end
      {",nav2", {{"/bv/obstacles", 1}, {"/bv/polygons", 1}, {"/bv/footprints", 1}}},
      {",vision", {{"/bv/boxes", 1}, {"/bv/detection_points", 1}, {"/bv/label_info", 0}}},
      {",points", {{"/bv/points", 1}}}};
  for (const std::string kind : {"mcap", "rosbag2"}) {
    std::string options;
    TopicSizes expected = always;
    for (auto option = added.begin();; ++option) {
      const std::string file = (path_ / (kind + std::to_string(options.size()))).string();
      const Found found;
      const auto sink = make_sink(parse_sink(kind + ":" + file + options));
      sink->write(found.frame, found.result);
      sink->close();
      EXPECT_EQ(topics_of(file), expected) << kind << options;
      if (option == added.end()) break;
      options += option->first;
      expected.insert(option->second.begin(), option->second.end());
    }
  }
}

TEST(ParseSink, NamesAllKindsInItsErrors) {
  EXPECT_EQ(parse_sink("vtp:a,points").target, "a");
  EXPECT_TRUE(parse_sink("vtp:a,points").points);
  EXPECT_EQ(parse_sink("csv:a,points").target, "a,points");
  EXPECT_EQ(parse_sink("jsonl:a:b").target, "a:b");
  const SinkOptions both = parse_sink("mcap:a,b.mcap,moveit,points,moveit");
  EXPECT_EQ(both.target, "a,b.mcap");
  EXPECT_TRUE(both.points);
  EXPECT_THAT(both.adapters, testing::ElementsAre("moveit"));
  EXPECT_THROW(parse_sink("vtp:a,moveit"), std::invalid_argument);
  EXPECT_THROW(parse_sink("mcap:a,nav-2"), std::invalid_argument);
  EXPECT_THROW(parse_sink("vtp:a,"), std::invalid_argument);
  EXPECT_THROW(parse_sink("vtp:-"), std::invalid_argument);
  EXPECT_EQ(parse_sink("vtp:a,moveit/").target, "a,moveit/");
  EXPECT_EQ(parse_sink("vtp:a,2026").target, "a,2026");
  for (const char* bad : {"", "jsonl", "csv:", "vtp:,points", "xml:a", "json:a", ":a"}) {
    try {
      parse_sink(bad);
      FAIL() << bad;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(),
                "'" + std::string(bad) +
                    "' is not jsonl:FILE, csv:FILE, kitti:FILE, mcap:FILE[,points][,moveit][,nav2][,vision], "
                    "rosbag2:FOLDER[,points][,moveit][,nav2][,vision], dds:PREFIX[,moveit][,nav2][,vision], "
                    "ws:[HOST:]PORT, vtp:FOLDER[,points], image:FOLDER or labels:FOLDER");
    }
  }
}

// Throws what its frame's seq says.
struct BadSink : FrameSink {
  void write(const Frame& frame, const FrameResult&) override {
    ++asked;
    if (frame.header.seq == 1) throw std::runtime_error("one is bad");
    if (frame.header.seq == 2) throw 2;
    if (frame.header.seq == 3) throw IoError("no space");
    if (frame.header.seq == 4) throw ClosedPipe("nobody reads");
  }
  int asked = 0;
};

TEST(SinkGroup, NoSinkHarmsAnotherOrTheStream) {
  std::vector<std::string> said;
  SinkGroup group([&](const std::string& text) { said.push_back(text); });
  int results = 0;
  auto bad = std::make_unique<BadSink>();
  const BadSink& asked = *bad;
  group.add("bad", std::move(bad));
  group.add("good", make_sink([&](const Frame&, const FrameResult&) { ++results; }));
  Frame frame;
  int asked_before_the_end = 0;
  for (const std::uint64_t seq : {0, 1, 1, 2, 0, 3, 0, 0}) {
    frame.header.seq = seq;
    if (seq == 3) asked_before_the_end = asked.asked;
    group.write(frame, {});
  }
  group.close();
  EXPECT_EQ(asked_before_the_end, 5);
  EXPECT_EQ(results, 8);
  EXPECT_TRUE(group.failed());
  EXPECT_TRUE(group.alive());
  EXPECT_EQ(said, (std::vector<std::string>{"bad: one is bad", "bad: an exception that is no std::exception",
                                            "bad: no space", "bad: 6 frames were not written"}));
}

TEST(SinkGroup, IsDeadWithItsLastSinkAndQuietAboutAReaderWhoLeft) {
  SinkGroup group([](const std::string& text) { ADD_FAILURE() << text; });
  group.add("bad", std::make_unique<BadSink>());
  EXPECT_TRUE(group.alive());
  Frame frame;
  frame.header.seq = 4;
  group.write(frame, {});
  EXPECT_FALSE(group.alive());
  group.write(frame, {});
  group.write_lost(frame, "dropped: queue");
  group.close();
  EXPECT_FALSE(group.failed());
}

TEST(SinkGroup, MeasuresEachSink) {
  SinkGroup group([](const std::string&) {});
  group.add("slow", make_sink([](const Frame&, const FrameResult&) {
              std::this_thread::sleep_for(std::chrono::milliseconds(20));
            }));
  group.add("fast", make_sink([](const Frame&, const FrameResult&) {}));
  for (int i = 0; i < 3; ++i)
    group.write({}, {});
  const auto times = group.times();
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].first, "slow");
  EXPECT_EQ(times[1].second.count(), 3U);
  EXPECT_GE(times[0].second.percentile(0.01), 20);
}

TEST_F(FrameSinks, DoNotDependOnTheLocale) {
  const auto written = [&](const std::string& folder) {
    SinkGroup group([](const std::string&) {});
    std::filesystem::create_directory(path_ / folder);
    for (const std::string sink :
         {"jsonl:a.jsonl", "csv:a.csv", "labels:labels", "vtp:vtp", "mcap:a.mcap", "rosbag2:bag"}) {
      const std::size_t name = sink.find(':') + 1;
      group.add(parse_sink(sink.substr(0, name) + (path_ / folder / sink.substr(name)).string()));
    }
    Found found;
    found.frame.header.stamp_ns = 1'700'000'000'123'456'789;
    group.write(found.frame, found.result);
    group.close();
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_ / folder)) {
      const std::string name = entry.path().lexically_relative(path_).string().substr(folder.size());
      if (entry.is_regular_file() && entry.path().extension() != ".db3") files[name] = read(folder + name);
    }
    return files;
  };
  const auto before = written("posix");
  EXPECT_GE(before.size(), 6U);
  EXPECT_THAT(before.at("/bag/metadata.yaml"), HasSubstr("nanoseconds_since_epoch: 1700000000123456789\n"));
  const test::GermanLocale german;
  EXPECT_TRUE(before == written("german"));
}

// Opens all and one more that cannot be; gives that one's error.
std::string open_in_vain(const std::vector<std::string>& sinks, const std::function<void()>& meanwhile = {}) {
  SinkGroup group([](const std::string&) {});
  try {
    for (const std::string& sink : sinks)
      group.add(parse_sink(sink));
    if (meanwhile) meanwhile();
    group.add(parse_sink("jsonl:/proc/none/a.jsonl"));
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST_F(FrameSinks, OpenedInVainLeaveWhatWasThere) {
  const std::vector<std::string> sinks = {"mcap:" + (path_ / "a.mcap").string(),
                                          "rosbag2:" + (path_ / "drive").string(),
                                          "jsonl:" + (path_ / "a.jsonl").string()};
  const std::vector<std::string> files = {"a.mcap", "drive/drive_0.db3", "drive/metadata.yaml", "a.jsonl"};
  {
    SinkGroup group([](const std::string&) {});
    for (const std::string& sink : sinks)
      group.add(parse_sink(sink));
    const Found found;
    group.write(found.frame, found.result);
    group.close();
  }
  std::vector<std::string> before, after;
  for (const std::string& file : files)
    before.push_back(read(file));
  EXPECT_THAT(open_in_vain(sinks), HasSubstr("/proc/none/a.jsonl"));
  for (const std::string& file : files)
    after.push_back(read(file));
  EXPECT_TRUE(before == after);
  EXPECT_THAT(before, testing::Each(testing::Not(testing::IsEmpty())));
}

TEST_F(FrameSinks, OpenedInVainRemoveWhatTheyMadeAndNothingElse) {
  const auto at = [&](const char* name) { return (path_ / name).string(); };
  EXPECT_NE(open_in_vain({"mcap:" + at("a.mcap"), "rosbag2:" + at("drive"), "labels:" + at("labels"),
                          "vtp:" + at("vtp"), "csv:" + at("a.csv"), "image:" + at("shared")},
                         [&] { write("shared/another.png", "of another process"); }),
            "");
  for (const char* name : {"a.mcap", "drive", "labels", "vtp", "a.csv"})
    EXPECT_FALSE(std::filesystem::exists(path_ / name)) << name;
  EXPECT_EQ(read("shared/another.png"), "of another process");
}

}  // namespace
}  // namespace pcl_bv::detail
