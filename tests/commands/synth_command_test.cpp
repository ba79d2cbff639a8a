// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command synth, run as users run it: by exit status, files and what it says where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/synth/rural_road.h"
#include "pcl_bv/synth/street.h"
#include "pcl_bv/synth/synth.h"
#include "pcl_bv/synth/town.h"
#include "temporary_folder.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
  int status;
  std::string out, err;
};

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  return content.str();
}

class SynthCommand : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_ / name; }

  Outcome run(const std::string& arguments) const {
    const std::string command = std::string(PCL_BV_BIN_DIR "/synth ") + arguments + " >" +
                                path("out").string() + " 2>" + path("err").string() + " </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(path("out")), content_of(path("err"))};
  }

 private:
  test::TemporaryFolder folder_;
};

void expect_truth(const std::string& line, const RuralRoadFrame& frame, std::size_t number) {
  const auto truth = nlohmann::json::parse(line);
  EXPECT_EQ(truth.at("seq"), number);
  EXPECT_EQ(truth.at("stamp_ns"), 100'000'000 * number);
  EXPECT_EQ(truth.at("pose").get<std::vector<double>>(),
            std::vector<double>(frame.pose.begin(), frame.pose.end()));
  ASSERT_EQ(truth.at("objects").size(), frame.objects.size());
  std::size_t points = 0;
  for (std::size_t i = 0; i < frame.objects.size(); ++i) {
    const auto& told = truth.at("objects").at(i);
    const RuralRoadObject& object = frame.objects[i];
    EXPECT_EQ(told.at("id"), object.id);
    EXPECT_EQ(told.at("class"), name_of(object.kind));
    EXPECT_EQ((told.at("center").get<std::array<double, 3>>()), object.center);
    EXPECT_EQ((told.at("axes").get<std::array<std::array<double, 3>, 3>>()), object.axes);
    EXPECT_EQ((told.at("velocity").get<std::array<double, 3>>()), object.velocity);
    EXPECT_EQ(told.at("yaw_rate"), object.yaw_rate);
    EXPECT_EQ(told.at("yaw"), std::atan2(object.axes[0][1], object.axes[0][0]));
    EXPECT_EQ(told.at("size").at(0), 2 * object.half_extents[0]);
    points += told.at("points").get<std::size_t>();
  }
  const auto& owners = frame.cloud.object;
  EXPECT_EQ(points, owners.size() - static_cast<std::size_t>(std::count(owners.begin(), owners.end(), 0U)));
}

TEST_F(SynthCommand, WritesTheSceneThatTheLibraryMakes) {
  for (const std::string scene : {"gauss:1000:3", "street:6400:2", "paper-4010"}) {
    SCOPED_TRACE(scene);
    const Outcome outcome = run(scene + " " + path("a.pcd").string());
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
    const RawCloud cloud = read_pcd(path("a.pcd"));
    const RawCloud expected = to_raw_cloud(make_synth(parse_synth(scene)));
    EXPECT_EQ(cloud.data, expected.data);
    EXPECT_EQ(cloud.width, expected.width);
    EXPECT_EQ(cloud.height, expected.height);
    EXPECT_THAT(content_of(path("a.pcd")), HasSubstr("\nDATA binary\n"));
  }
}

TEST_F(SynthCommand, WritesASequenceIntoAFolderThatItMakes) {
  const fs::path sweeps = path("sweeps");
  const Outcome outcome = run("street-sequence:2:7 " + sweeps.string());
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_EQ(std::distance(fs::directory_iterator(sweeps), fs::directory_iterator{}), 2);
  for (const std::size_t frame : {0u, 1u}) {
    const fs::path file = sweeps / ("000000000" + std::to_string(frame) + ".pcd");
    EXPECT_EQ(read_pcd(file).data, to_raw_cloud(make_street_frame({128'000, 7}, frame).cloud).data);
  }
}

TEST_F(SynthCommand, WritesTheRuralRoadWithPosesAndTruth) {
  const fs::path road = path("road");
  const Outcome outcome = run("rural-road-sequence-16:3:7 " + road.string());
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_EQ(std::distance(fs::directory_iterator(road), fs::directory_iterator{}), 5);
  std::istringstream poses(content_of(road / "poses.txt")), truths(content_of(road / "truth.jsonl"));
  for (std::size_t number = 0; number < 3; ++number) {
    SCOPED_TRACE(number);
    const RuralRoadFrame frame = make_rural_road_frame({7, 16}, number);
    const RawCloud cloud = read_pcd(road / ("000000000" + std::to_string(number) + ".pcd"));
    EXPECT_EQ(cloud.data, to_raw_cloud(frame.cloud).data);
    for (const char* const field : {"object", "ground", "vegetation", "class"}) {
      const auto has = [field](const PointField& f) { return f.name == field; };
      EXPECT_TRUE(std::any_of(cloud.fields.begin(), cloud.fields.end(), has)) << field;
    }
    for (const double value : frame.pose) {
      double read = 0;
      EXPECT_TRUE(poses >> read);
      EXPECT_EQ(read, value);
    }
    std::string line;
    ASSERT_TRUE(std::getline(truths, line));
    expect_truth(line, frame, number);
  }
  std::string more;
  EXPECT_FALSE(poses >> more);
  EXPECT_FALSE(std::getline(truths, more));
}

TEST_F(SynthCommand, WritesTheSameTilesOfATownForAnyNumberOfThreadsAndOfTiles) {
  const auto tiles = [&](const std::string& arguments, const std::string& folder) {
    const Outcome outcome = run(arguments + " " + path(folder).string());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
    return std::distance(fs::directory_iterator(path(folder)), fs::directory_iterator{});
  };
  EXPECT_EQ(tiles("town:9:3:5000", "all"), 9);
  EXPECT_EQ(tiles("town:4:3:5000", "some"), 4);
  const Town town({3, 5000, true});
  for (std::size_t number = 0; number < 9; ++number) {
    const TownTile tile = town_tile(number);
    const fs::path all = path("all") / town_file_name(tile), some = path("some") / town_file_name(tile);
    EXPECT_EQ(read_pcd(all).data, to_raw_cloud(town.tile(tile)).data);
    EXPECT_EQ(fs::exists(some), number < 4);
    if (number < 4) {
      EXPECT_EQ(content_of(some), content_of(all));
    }
  }
}

TEST_F(SynthCommand, SaysInOneLineWhyAnOutputWasNotWritten) {
  std::ofstream(path("file")) << "not a folder";
  const std::string below_a_file = (path("file") / "a.pcd").string();
  for (const std::string& arguments : {"box:10 " + below_a_file, "street-sequence:1 " + path("file").string(),
                                       "town:4 " + path("file").string()}) {
    SCOPED_TRACE(arguments);
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, StartsWith("synth: " + arguments.substr(arguments.find(' ') + 1) + ": "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  }
}

TEST_F(SynthCommand, MakesNoFolderThatItsOutputDoesNotName) {
  for (const std::string scene : {"box:10 ", "street-sequence:2:7 "}) {
    EXPECT_EQ(run(scene + (path("new") / "a.pcd").string()).status, 1);
    EXPECT_FALSE(fs::exists(path("new")));
  }
}

TEST_F(SynthCommand, WrongUseIsStatusTwoAndWritesNothing) {
  const std::string file = path("a.pcd").string();
  for (const std::string& arguments :
       {std::string(), std::string("box"), "cube " + file, "box:0 " + file, "paper-4010:5 " + file,
        "street-sequence:0 " + file, "rural-road-sequence-17 " + file, "rural-road-sequence:0 " + file,
        "rural-road:7 " + file, "town:0 " + file, "town:4:1:10 " + file, "box " + file + " more",
        "--unknown box " + file}) {
    SCOPED_TRACE(arguments);
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err, "");
    EXPECT_FALSE(fs::exists(file));
  }
}

TEST_F(SynthCommand, HelpNamesTheScenesAndShowsExamples) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("paper-327323"));
  EXPECT_THAT(outcome.out, HasSubstr("synth street-sequence"));
  EXPECT_THAT(outcome.out, HasSubstr("synth rural-road-sequence-16"));
  EXPECT_THAT(outcome.out, HasSubstr("synth town:64"));
}

}  // namespace
}  // namespace pcl_bv::detail
