// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Inputs that name many things: topics, chunks, attributes, links, frames, keys, fields. Time and memory grow
// with the bytes, or a limit is said in one line.

#include "growth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../recording/made_mcap.h"
#include "codecs.h"
#include "folder.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/nodes/stream_runner.h"
#include "pcl_bv/report/read_volumes.h"
#include "stream/rig/transforms.h"
#include "stream/rig/urdf.h"
#include "stream/sources/recorded_clouds.h"
#include "stream/sources/sources.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string numbered(std::size_t n, const std::function<std::string(std::size_t)>& text) {
  std::string all;
  for (std::size_t i = 0; i < n; ++i)
    all += text(i);
  return all;
}

template <typename Do>
std::string error_of(const Do& work) {
  try {
    work();
  } catch (const std::exception& error) {
    EXPECT_LE(std::string(error.what()).size(), kMaxMessageBytes);
    return error.what();
  }
  return "no error";
}

class Growth : public Folder {
 protected:
  std::size_t put(const std::string& name, const std::string& bytes) {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return bytes.size();
  }
};

// An MCAP file without summary, of empty topics with clouds.
std::string empty_topics(std::size_t n) {
  std::vector<std::byte> bytes;
  mcap::Writer writer(bytes);
  writer.bytes(mcap::kMagic.data(), mcap::kMagic.size());
  mcap::put(writer, mcap::Schema{1, "sensor_msgs/msg/PointCloud2", "ros2msg", ""});
  for (std::size_t i = 0; i < n; ++i)
    mcap::put(writer,
              mcap::Channel{static_cast<std::uint16_t>(i + 1), 1, "/points" + std::to_string(i), "cdr", {}});
  writer.begin(mcap::Op::data_end);
  writer.number(std::uint32_t{0});
  writer.end();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(Growth, OfEmptyTopicsIsThatOfTheFileAndTheMessageNamesAFew) {
  const std::string file = (path_ / "a.mcap").string();
  test::expect_linear(
      "topics of MCAP", 8000, 60, [&](std::size_t n) { return put("a.mcap", empty_topics(n)); },
      [&] { EXPECT_GE(recorded_cloud_topics(file).size(), 8000U); });
  EXPECT_THAT(
      error_of([&] { RecordedClouds(file, ""); }),
      HasSubstr("several topics have clouds: /points0, /points1, /points2, /points3, /points4, /points5, "
                "/points6, /points7 and 31992 more; choose one with --topic"));
  EXPECT_THAT(error_of([&] { RecordedClouds(file, std::string(100'000, 'x')); }),
              HasSubstr("and 31992 more"));
  RigConfig rig;
  rig.frame = "base";
  EXPECT_THAT(error_of([&] { open_rig({file}, rig, {}); }),
              HasSubstr("32000 topics with clouds; at most 256"));
}

std::string bag_field(const std::string& name, const std::string& value) {
  const std::string field = name + "=" + value;
  const auto size = static_cast<std::uint32_t>(field.size());
  return std::string(reinterpret_cast<const char*>(&size), 4) + field;
}

std::string bag_record(const std::string& header, const std::string& data) {
  const auto head = static_cast<std::uint32_t>(header.size()), size = static_cast<std::uint32_t>(data.size());
  return std::string(reinterpret_cast<const char*>(&head), 4) + header +
         std::string(reinterpret_cast<const char*>(&size), 4) + data;
}

TEST_F(Growth, OfConnectionsIsThatOfTheBag) {
  test::expect_linear(
      "connections of a bag", 50'000, 60,
      [&](std::size_t n) {
        return put("a.bag", "#ROSBAG V2.0\n" + numbered(n, [](std::size_t i) {
                              const auto id = static_cast<std::uint32_t>(i);
                              return bag_record(
                                  bag_field("op", "\7") + bag_field("topic", "/t" + std::to_string(i)) +
                                      bag_field("conn", {reinterpret_cast<const char*>(&id), 4}),
                                  bag_field("type", "sensor_msgs/PointCloud2"));
                            }));
      },
      [&] { EXPECT_GE(open_recording(path_ / "a.bag")->topics().size(), 50'000U); });
}

TEST_F(Growth, OfChunksOfTheSameTimeIsThatOfTheFile) {
  test::expect_linear(
      "chunks of one time", 2000, 60,
      [&](std::size_t n) {
        McapBuilder made;
        for (std::size_t i = 0; i < n; ++i)
          made.chunk({5, 1000 + i}, i == 0);
        return put("a.mcap", made.closed(true, true, nullptr));
      },
      [&] {
        const std::vector<std::int64_t> times = times_of(*open_recording(path_ / "a.mcap"));
        EXPECT_GE(times.size(), 4000U);
        EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
      });
}

TEST_F(Growth, OfAttributesEndsAtALimitThatIsSaid) {
  const auto robot = [](std::size_t attributes) {
    return "<!-- <a \"\" -->\n<robot><link " +
           numbered(attributes, [](std::size_t i) { return "a" + std::to_string(i) + "='>' "; }) +
           "/></robot>";
  };
  put("a.urdf", robot(100));
  EXPECT_THAT(read_urdf(path_ / "a.urdf").shapes, IsEmpty());
  put("a.urdf", robot(1'000'000));
  EXPECT_THAT(error_of([&] { read_urdf(path_ / "a.urdf"); }),
              HasSubstr("line 2, column 8: an element has more than 100 attributes"));
}

// Links in a chain, of which each has a shape.
std::string chain(std::size_t n) {
  return "<robot>" +
         numbered(n,
                  [](std::size_t i) {
                    const std::string own = std::to_string(i), next = std::to_string(i + 1);
                    return "<link name='l" + own +
                           "'><collision><geometry><sphere radius='1'/></geometry></collision></link>" +
                           "<joint name='j" + own + "' type='fixed'><parent link='l" + own +
                           "'/><child link='l" + next + "'/></joint>";
                  }) +
         "</robot>";
}

TEST_F(Growth, OfLinksIsThatOfTheRobot) {
  test::expect_linear(
      "links", 1000, 100, [&](std::size_t n) { return put("a.urdf", chain(n)); },
      [&] { EXPECT_GE(read_urdf(path_ / "a.urdf").shapes.size(), 1000U); });
  put("a.urdf", chain(9000));
  std::vector<std::string> problems;
  EXPECT_EQ(read_urdf(path_ / "a.urdf").volumes_in("l0", problems).size(), 9000U);
  EXPECT_THAT(problems, IsEmpty());
}

TEST_F(Growth, OfLinksBeyondTheLimitIsSaidInAFewLines) {
  put("a.urdf", chain(12'000));
  std::vector<std::string> problems;
  EXPECT_LT(read_urdf(path_ / "a.urdf").volumes_in("l0", problems).size(), 12'000U);
  ASSERT_EQ(problems.size(), 21U);
  EXPECT_THAT(problems[0], HasSubstr("more than 10000 frames"));
  EXPECT_THAT(problems[1], HasSubstr("of the first 10000 frames"));
  EXPECT_THAT(problems[20], HasSubstr("more parts of the URDF have problems"));
}

TEST_F(Growth, OfShapesWithoutAMeshIsSaidInAFewLines) {
  put("a.urdf", "<robot><link name='" + std::string(200'000, 'l') + "'>" + numbered(100, [](std::size_t) {
                  return "<collision><geometry><mesh filename='a.dae'/></geometry></collision>";
                }) + "</link></robot>");
  const Urdf urdf = read_urdf(path_ / "a.urdf");
  EXPECT_EQ(urdf.warnings.size(), 21U);
  for (const std::string& line : urdf.warnings)
    EXPECT_LE(line.size(), kMaxMessageBytes);
}

TEST_F(Growth, OfPosesThatComeBackwardsIsLinear) {
  Transforms transforms;
  const Pose pose = Pose::Identity();
  for (std::int64_t i = 0; i < 400'000; ++i)
    transforms.add("odom", "base", 1'000'000'000 - 1000 * i, pose);
  EXPECT_TRUE(transforms.find("odom", "base", 999'999'500).pose);
}

TEST_F(Growth, OfFramesInTwoChainsIsLinear) {
  Transforms transforms;
  for (int i = 0; i < 4900; ++i) {
    transforms.add_fixed(i == 0 ? "root" : "a" + std::to_string(i), "a" + std::to_string(i + 1),
                         Pose::Identity());
    transforms.add_fixed(i == 0 ? "root" : "b" + std::to_string(i), "b" + std::to_string(i + 1),
                         Pose::Identity());
  }
  for (int i = 0; i < 200; ++i)
    EXPECT_TRUE(transforms.find("a4900", "b4900", i).pose);
  EXPECT_THAT(transforms.take_warnings(), IsEmpty());
}

TEST_F(Growth, OfAliasesInSettingsEndsAtALimitThatIsSaid) {
  const std::string many = numbered(5000, [](std::size_t i) { return "k" + std::to_string(i) + ": 1, "; });
  EXPECT_THAT(error_of([&] {
                parse_stream_config(
                    "a: &x {" + many + "}\n" +
                        numbered(50'000, [](std::size_t i) { return "b" + std::to_string(i) + ": *x\n"; }),
                    "f.yaml");
              }),
              HasSubstr("has more than 4096 keys"));
  EXPECT_THAT(error_of([&] {
                parse_stream_config("cluster: {classes: [&x {value: 1, volumes: [" +
                                        numbered(50'000, [](std::size_t) { return "aabb, "; }) + "]}, " +
                                        numbered(4000, [](std::size_t) { return "*x, "; }) + "]}",
                                    "f.yaml");
              }),
              HasSubstr("has more than 4096 entries"));
  EXPECT_THAT(error_of([&] { parse_stream_config("? " + std::string(1'000'000, 'k') + "\n: 1", "f.yaml"); }),
              HasSubstr(": unknown key 'kkk"));
}

TEST_F(Growth, OfFilesInMetadataIsBoundedAndSaid) {
  std::filesystem::create_directory(path_ / "bag");
  put("bag/metadata.yaml", "rosbag2_bagfile_information:\n  relative_file_paths: [" +
                               numbered(1'000'000, [](std::size_t) { return "a,"; }) + "]\n");
  EXPECT_THAT(error_of([&] { open_recording(path_ / "bag"); }),
              HasSubstr("metadata.yaml: has more than 500000 values"));
}

TEST_F(Growth, OfACompressedRecordingEndsAtALimitThatIsSaid) {
  const std::vector<std::byte> zeros(std::size_t{256} << 20);
  std::vector<std::byte> packed;
  Compressor().compress(Compression::zstd, zeros.data(), zeros.size(), packed);
  put("a.mcap.zstd", {reinterpret_cast<const char*>(packed.data()), packed.size()});
  EXPECT_THAT(error_of([&] { open_recording(path_ / "a.mcap.zstd"); }),
              HasSubstr("zstd: more than 67108864 bytes"));
}

TEST_F(Growth, OfFieldsIsThatOfTheHeader) {
  test::expect_linear(
      "fields of .pcd", 1000, 150,
      [&](std::size_t n) {
        const auto words = [&](const std::string& word) {
          return numbered(n, [&](std::size_t) { return " " + word; });
        };
        return put("a.pcd", "VERSION .7\nFIELDS x y z" +
                                numbered(n, [](std::size_t i) { return " f" + std::to_string(i); }) +
                                "\nSIZE 4 4 4" + words("4") + "\nTYPE F F F" + words("F") + "\nCOUNT 1 1 1" +
                                words("1") + "\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3" + words("0") +
                                "\n");
      },
      [&] { EXPECT_EQ(read_cloud(path_ / "a.pcd").size(), 1U); });
  test::expect_linear(
      "elements of .ply", 5000, 120,
      [&](std::size_t n) {
        return put("a.ply", "ply\nformat ascii 1.0\n" +
                                numbered(n,
                                         [](std::size_t i) {
                                           return "element e" + std::to_string(i) +
                                                  " 0\nproperty float a\nproperty float b\n";
                                         }) +
                                "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                                "end_header\n1 2 3\n");
      },
      [&] { EXPECT_EQ(read_cloud(path_ / "a.ply").size(), 1U); });
}

TEST_F(Growth, OfColumnsIsThatOfTheTable) {
  test::expect_linear(
      "columns of .csv", 900, 120,
      [&](std::size_t n) {
        return put("a.csv", "x,y,z" + numbered(n, [](std::size_t i) { return ",c" + std::to_string(i); }) +
                                "\n" + numbered(4, [&](std::size_t) {
                                  return "1,2,3" +
                                         numbered(n, [](std::size_t) { return std::string(",4"); }) + "\n";
                                }));
      },
      [&] { EXPECT_EQ(read_cloud(path_ / "a.csv").size(), 4U); });
}

TEST_F(Growth, OfKeysOfVolumesAndLabelsIsThatOfTheJson) {
  const std::string ball = R"({"shape":"sphere","center":[0,0,0],"radius":9})";
  test::expect_linear(
      "volumes", 5000, 60,
      [&](std::size_t n) {
        return put("a.json", "[" + ball + numbered(n, [&](std::size_t) { return "," + ball; }) + "]");
      },
      [&] { EXPECT_GE(read_volumes(path_ / "a.json").size(), 5000U); });
  // A long name around many short ones, which was copied for each of them.
  test::expect_linear(
      "names of labels", 10'000, 60,
      [&](std::size_t n) {
        return put("a.json",
                   R"({"openlabel":{")" + std::string(20 * n, 'n') + R"(":{)" +
                       numbered(n, [](std::size_t i) { return "\"" + std::to_string(i) + "\":{},"; }) +
                       R"("cuboid":[{"val":[0,0,0,0,0,0,1,1,1]}]}}})");
      },
      [&] { EXPECT_EQ(read_volumes(path_ / "a.json").size(), 1U); });
}

}  // namespace
}  // namespace pcl_bv::detail
