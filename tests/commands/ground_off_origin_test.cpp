// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A street in another frame than its sensor's, through the commands: the same ground and objects, and a line.

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>

#include "command.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/synth/street.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

using testing::HasSubstr;

class GroundOffOrigin : public PcdBv {
 protected:
  /// A street's returns as doubles, each moved, and a viewpoint.
  template <typename Move>
  std::string street(std::string_view name, const Move& move, const std::array<double, 3>& viewpoint = {}) {
    const SynthCloud cloud = make_street_frame({60'000, 2}, 0).cloud;
    std::vector<double> xyz;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d p(cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]);
      if (p.squaredNorm() <= 1) continue;
      const Eigen::Vector3d moved = move(p);
      xyz.insert(xyz.end(), moved.data(), moved.data() + 3);
    }
    RawCloud raw;
    raw.fields = {{"x", 'F', 8, 1, 0}, {"y", 'F', 8, 1, 8}, {"z", 'F', 8, 1, 16}};
    raw.point_step = 24;
    raw.width = xyz.size() / 3;
    raw.data.resize(8 * xyz.size());
    std::memcpy(raw.data.data(), xyz.data(), raw.data.size());
    std::copy(viewpoint.begin(), viewpoint.end(), raw.viewpoint.begin());
    write_pcd(at(name), raw);
    return at(name);
  }

  std::string aside(std::string_view name, double x, double y, double z,
                    const std::array<double, 3>& viewpoint = {}) {
    return street(
        name, [=](const Eigen::Vector3d& p) { return Eigen::Vector3d(p + Eigen::Vector3d(x, y, z)); },
        viewpoint);
  }

  Result objects(const std::string& cloud, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"--ground", "zones",    "--cluster", "0.5",      "--min-size",
                                       "30",       "--volume", "aabb",      "--format", "jsonl"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.push_back(cloud);
    return run(arguments);
  }

  static void expect_street(const Result& result) {
    ASSERT_EQ(result.status, 0) << result.err;
    const Json report = result.json();
    EXPECT_NEAR(report["counts"]["ground"].get<double>(), 26'785, 30);
    EXPECT_NEAR(static_cast<double>(report["clusters"].size()), 52, 1);
  }
};

TEST_F(GroundOffOrigin, IsRightAndHasALine) {
  expect_street(objects(aside("sensor.pcd", 0, 0, 0)));
  EXPECT_EQ(objects(at("sensor.pcd")).err, "");
  for (const auto& [x, y, z] :
       {std::array{100.0, 0.0, 0.0}, {200, 0, 0}, {-70, 0, 3}, {500'000, 4'649'776, 120}}) {
    const Result result = objects(aside("aside.pcd", x, y, z));
    expect_street(result);
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_THAT(result.err, HasSubstr("the points do not lie around the origin"));
    EXPECT_THAT(result.err, HasSubstr("use --sensor"));
  }
}

TEST_F(GroundOffOrigin, TakesTheViewpointOfTheFileWithoutALine) {
  const Result result = objects(aside("view.pcd", 100, 50, 2, {100, 50, 2}));
  expect_street(result);
  EXPECT_EQ(result.json()["counts"]["ground"],
            objects(aside("sensor.pcd", 0, 0, 0)).json()["counts"]["ground"]);
  EXPECT_THAT(result.err, testing::Not(HasSubstr("do not lie around")));
  expect_street(objects(aside("wrong.pcd", 0, 0, 0, {100, 50, 2})));  // of a registration: not where they lie
  expect_street(objects(at("view.pcd"), {"--origin", "100,50,2"}));
}

TEST_F(GroundOffOrigin, TakesThePlaceThatIsGiven) {
  const std::string cloud = aside("aside.pcd", 100, 50, 0);
  const Result right = objects(cloud, {"--sensor", "100,50,0"});
  expect_street(right);
  EXPECT_EQ(right.err, "");
  const Result wrong = objects(cloud, {"--sensor", "300,0,0"});
  EXPECT_THAT(wrong.err, HasSubstr("few points lie around --sensor (300.0, 0.0, 0.0)"));
  EXPECT_EQ(objects(cloud, {"--sensor", "300,0"}).status, 2);
  EXPECT_THAT(run({"--sensor", "1,2,3", cloud}).err, HasSubstr("--sensor: only useful with --ground zones"));
  const Result plane = run({"--ground", "plane", "--sensor", "1,2,3", cloud});
  EXPECT_EQ(plane.status, 2);
  EXPECT_THAT(plane.err, HasSubstr("--sensor: only useful with --ground zones"));
}

TEST_F(GroundOffOrigin, UpsideDownHasALineThatSaysWhichWayIsUp) {
  const std::string cloud =
      street("down.pcd", [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), -p.y(), -p.z()); });
  const Result result = objects(cloud);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.error_lines(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("only 9 % of the points are ground (up is z)"));
  EXPECT_THAT(result.err, HasSubstr("use --up -z"));
  expect_street(objects(cloud, {"--up", "-z"}));
}

TEST_F(GroundOffOrigin, ACamerasCloudHasALineThatSaysWhichWayIsUp) {
  const std::string cloud =
      street("camera.pcd", [](const Eigen::Vector3d& p) { return Eigen::Vector3d(-p.y(), -p.z(), p.x()); });
  const Result result = run({"--ground", "plane", "--volume", "aabb", cloud});
  EXPECT_THAT(result.err, HasSubstr("no ground found (up is z): try --up -y (49 %"));
}

TEST_F(GroundOffOrigin, RangesAndGrowingTolerancesAreSaidToCountFromTheOrigin) {
  const std::string cloud = aside("aside.pcd", 100, 0, 0);
  EXPECT_THAT(run({"--cluster", "0.5", "--range", "0.5:60", "--volume", "aabb", cloud}).err,
              HasSubstr("--range MAX is measured from the origin, but the points do not lie around it"));
  EXPECT_THAT(
      run({"--cluster", "0.3:0.01", "--volume", "aabb", cloud}).err,
      HasSubstr("--cluster PER_METRE is measured from the origin, but the points do not lie around it"));
  EXPECT_EQ(run({"--cluster", "0.5", "--volume", "aabb", cloud}).err, "");
}

// Whatever is subtracted from the coordinates, the sensor stays where it was, and with it what is measured
// from it: ranges, growing tolerances, ground zones and the height above the ground.
TEST_F(GroundOffOrigin, AnOriginLeavesTheSensorWhereItIs) {
  const std::string cloud = aside("sensor.pcd", 0, 0, 0);
  for (const std::vector<std::string>& settings :
       {std::vector<std::string>{"--cluster", "0.3:0.02"},
        {"--cluster", "0.3", "--range", "8:40"},
        {"--preset", "road"},
        {"--cluster", "0.4", "--ground", "zones", "--sensor-height", "1.73"},
        {"--cluster", "0.4", "--ground", "plane", "--sensor-height", "1.73"}}) {
    std::vector<std::string> arguments{"--min-size", "30", "--volume", "aabb", "--format", "jsonl", cloud};
    arguments.insert(arguments.begin(), settings.begin(), settings.end());
    const Result right = run(arguments);
    ASSERT_EQ(right.status, 0) << right.err;
    const Json objects = right.json();
    ASSERT_GT(objects["clusters"].size(), 10U);
    for (const char* origin : {"auto", "5,-3,1", "100.5,200,0"}) {
      std::vector<std::string> moved = arguments;
      moved.insert(moved.begin(), {"--origin", origin});
      const Result result = run(moved);
      EXPECT_EQ(result.err, right.err) << settings[1] << ' ' << origin;
      const Json found = result.json();
      EXPECT_EQ(found["counts"], objects["counts"]) << settings[1] << ' ' << origin;
      ASSERT_EQ(found["clusters"].size(), objects["clusters"].size()) << settings[1] << ' ' << origin;
      for (std::size_t i = 0; i < objects["clusters"].size(); ++i) {
        const Json& before = objects["clusters"][i]["volumes"][0];
        const Json& after = found["clusters"][i]["volumes"][0];
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(after["max"][k].get<double>() + found["origin"][k].get<double>(),
                      before["max"][k].get<double>(), 1e-9);
      }
    }
  }
}

TEST_F(GroundOffOrigin, AnOriginFarAwayIsSaidToBeTakenForTheSensor) {
  const std::string cloud = aside("map.pcd", 500'000, 4'649'776, 120);
  const Result result = run({"--origin", "auto", "--cluster", "0.5:0.01", "--volume", "aabb", cloud});
  EXPECT_THAT(
      result.err,
      HasSubstr("the sensor is assumed at the new origin (--origin), because 0,0,0 is more than 500 m "
                "from it; used by: --cluster PER_METRE"));
  EXPECT_THAT(run({"--together", "--origin", "auto", "--range", "1:60", "--cluster", "0.5", "--volume",
                   "aabb", cloud})
                  .err,
              HasSubstr("used by: --range"));
  EXPECT_EQ(run({"--origin", "auto", "--cluster", "0.5", "--volume", "aabb", cloud}).err, "");
  const Result sensor = objects(cloud, {"--origin", "auto", "--sensor", "0,0,0"});
  EXPECT_EQ(sensor.status, 2);
  EXPECT_THAT(sensor.err, HasSubstr("--origin auto: cannot be combined with --sensor"));
}

TEST_F(GroundOffOrigin, ASensorHeightThatFitsNoPlaneHasALine) {
  EXPECT_THAT(objects(aside("sensor.pcd", 0, 0, 0), {"--sensor-height", "4"}).err,
              HasSubstr("no plane lies --sensor-height 4 m below the sensor"));
}

TEST_F(GroundOffOrigin, OfAStreamIsSaidOnce) {
  std::filesystem::create_directory(at("sweeps"));
  for (const char* name : {"sweeps/1.pcd", "sweeps/2.pcd", "sweeps/3.pcd"})
    aside(name, 100, 0.1 * name[7], 0);  // the densest place moves
  const Result result =
      run({"--source", at("sweeps"), "--rate", "max", "--ground", "zones", "--volume", "aabb"},
          {.program = "bv_stream"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.error_lines(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("sweeps/1.pcd: frame 0: the points do not lie around"));
}

}  // namespace
}  // namespace pcl_bv::test
