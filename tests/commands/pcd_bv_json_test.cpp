// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// JSON as a program reads it: the documented keys in their order, and numbers that still hold every point.

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "command.h"
#include "exact.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [key, value] : object.items())
    names.push_back(key);
  return names;
}

std::array<double, 3> triple(const Json& array) {
  return {array[0], array[1], array[2]};
}

/// The documented predicate of the shape, in rationals, on the numbers as read.
using ExactVector = std::array<Rational, 3>;

ExactVector between(const std::array<double, 3>& from, const std::array<double, 3>& to) {
  ExactVector result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = Rational(to[i]) - Rational(from[i]);
  return result;
}

Rational dot(const ExactVector& a, const ExactVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Rational square(const Json& number) {
  return Rational(number.get<double>()) * Rational(number.get<double>());
}

// The documented predicates of the round shapes, with the numbers as printed.
bool cylinder_holds(const Json& volume, const std::array<double, 3>& p) {
  const ExactVector q = between(triple(volume["center"]), p), a = between({0, 0, 0}, triple(volume["axis"]));
  const Rational along = dot(q, a), aa = dot(a, a);
  return dot(q, q) * aa - along * along <= square(volume["radius"]) * aa &&
         along * along <= square(volume["half_height"]) * aa;
}

bool capsule_holds(const Json& volume, const std::array<double, 3>& p) {
  const auto a = triple(volume["a"]), b = triple(volume["b"]);
  const ExactVector q = between(a, p), e = between(a, b), to_b = between(b, p);
  const Rational along = dot(q, e), ee = dot(e, e), rr = square(volume["radius"]);
  if (along <= 0) return dot(q, q) <= rr;
  if (along >= ee) return dot(to_b, to_b) <= rr;
  return dot(q, q) * ee - along * along <= rr * ee;
}

bool ellipsoid_holds(const Json& volume, const std::array<double, 3>& p) {
  const ExactVector q = between(triple(volume["center"]), p);
  Rational sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational along = dot(q, between({0, 0, 0}, triple(volume["axes"][i]))),
                   rr = square(volume["radii"][i]);
    if (rr == 0 && along != 0) return false;
    if (rr != 0) sum += along * along / rr;
  }
  return sum <= 1;
}

bool hull_holds(const Json& volume, const Coordinates& p) {
  for (const Json& plane : volume["planes"]) {
    if (exact_dot(triple(plane), p) > Rational(plane[3].get<double>())) return false;
  }
  return true;
}

bool prism_holds(const Json& volume, const Coordinates& p) {
  std::array<Rational, 3> at;
  for (std::size_t i = 0; i < 3; ++i)
    at[i] = exact_dot(triple(volume["axes"][i]), p);
  const auto number = [](const Json& value) { return Rational(value.get<double>()); };
  if (at[2] < number(volume["low"]) || at[2] > number(volume["high"])) return false;
  const Json& outline = volume["outline"];
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Json &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const Rational left = (number(b[0]) - number(a[0])) * (at[1] - number(a[1]));
    const Rational right = (number(b[1]) - number(a[1])) * (at[0] - number(a[0]));
    if (left < right) return false;
  }
  return true;
}

bool holds(const Json& volume, const Coordinates& p) {
  const std::string shape = volume["shape"];
  if (shape == "sphere") {
    const Rational radius(volume["radius"].get<double>());
    return exact_squared_distance(triple(volume["center"]), p) <= radius * radius;
  }
  if (shape == "obb") {
    const auto c = triple(volume["center"]);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = triple(volume["axes"][i]);
      const Rational at = exact_dot(axis, p) - exact_dot(axis, Coordinates{c[0], c[1], c[2]});
      if (abs(at) > Rational(volume["half_extents"][i].get<double>())) return false;
    }
    return true;
  }
  if (shape == "cylinder") return cylinder_holds(volume, {p.x, p.y, p.z});
  if (shape == "capsule") return capsule_holds(volume, {p.x, p.y, p.z});
  if (shape == "ellipsoid") return ellipsoid_holds(volume, {p.x, p.y, p.z});
  if (shape == "hull") return hull_holds(volume, p);
  if (shape == "prism") return prism_holds(volume, p);
  const Json axes = shape == "kdop" ? volume["directions"] : Json::parse("[[1,0,0],[0,1,0],[0,0,1]]");
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Rational at = exact_dot(triple(axes[i]), p);
    if (at < Rational(volume["min"][i].get<double>()) || at > Rational(volume["max"][i].get<double>()))
      return false;
  }
  return true;
}

TEST_F(PcdBv, JsonHasTheDocumentedKeysInTheirOrder) {
  const std::string cloud = ascii("c.pcd", {"1 2 3", "4 5 7", "nan 0 0"});
  const Result result =
      run({"--format", "jsonl", "--volume", "aabb,dop6,sphere-epos26", "--timings", "--check", cloud});
  EXPECT_EQ(result.out.back(), '\n');
  const Json report = result.json();
  using testing::ElementsAre;
  EXPECT_THAT(keys(report), ElementsAre("schema", "file", "points", "counts", "clusters", "seconds"));
  EXPECT_THAT(keys(report["counts"]),
              ElementsAre("nonfinite", "range", "ground", "small", "large", "noise", "inside", "class"));
  EXPECT_THAT(keys(report["seconds"]), ElementsAre("read", "segment", "fit"));
  EXPECT_THAT(keys(report["clusters"][0]), ElementsAre("id", "points", "volumes"));
  const Json& volumes = report["clusters"][0]["volumes"];
  EXPECT_THAT(keys(volumes[0]), ElementsAre("shape", "method", "volume", "min", "max", "outside"));
  EXPECT_THAT(keys(volumes[1]),
              ElementsAre("shape", "method", "volume", "directions", "min", "max", "outside"));
  EXPECT_THAT(keys(volumes[2]), ElementsAre("shape", "method", "volume", "center", "radius", "outside"));
  EXPECT_EQ(report["counts"]["nonfinite"], 1);
  EXPECT_EQ(report["clusters"][0]["points"], 2);
  EXPECT_EQ(volumes[0]["volume"], 36);
}

TEST_F(PcdBv, JsonIsAnArrayAndJsonLinesALineEach) {
  const std::string a = ascii("a.pcd", {"1 2 3"}), b = ascii("b.pcd", {"4 5 6"});
  const Json array = run({"--format", "json", a, b}).json();
  ASSERT_TRUE(array.is_array());
  ASSERT_EQ(array.size(), 2u);
  std::istringstream lines(run({"--format", "jsonl", a, b}).out);
  std::string line;
  std::size_t n = 0;
  while (std::getline(lines, line))
    EXPECT_EQ(Json::parse(line), array[n++]);
  EXPECT_EQ(n, 2u);
  EXPECT_EQ(run({"--format", "json", a}).json().size(), 1u);
}

TEST_F(PcdBv, VolumesReadBackFromJsonHoldEveryPointExactly) {
  for (const std::string scene : {"synth:street:6400:3", "synth:gauss:3000:4", "synth:sphere:2000:5"}) {
    SCOPED_TRACE(scene);
    const Result result =
        run({"--format", "jsonl", "--volume", "all", "--check", "--labels", at("labelled.pcd"), scene});
    ASSERT_EQ(result.status, 0) << result.err;
    const RawCloud cloud = read_pcd(at("labelled.pcd"));
    const Json report = result.json();
    ASSERT_FALSE(report["clusters"][0]["volumes"].empty());
    for (const Json& volume : report["clusters"][0]["volumes"]) {
      SCOPED_TRACE(volume["method"]);
      EXPECT_EQ(volume["outside"], 0);
      for (std::size_t i = 0; i < cloud.size(); ++i)
        ASSERT_TRUE(holds(volume, load_point(cloud.xyz(), i))) << i;
    }
  }
}

TEST_F(PcdBv, ExtremeMagnitudesReadBackExactly) {
  const std::string cloud =
      ascii("c.pcd", {"1e-41 -1e-20 1e38", "-0.0 3e-39 -1e38", "0.1 -0 5000000.5", "-0.0 1e20 0.3333333"});
  const Result result = run({"--format", "jsonl", "--volume", "all,hull", "--check", cloud});
  EXPECT_EQ(result.status, 0) << result.err;
  const RawCloud points = read_pcd(cloud);
  const Json report = result.json();
  ASSERT_FALSE(report["clusters"][0]["volumes"].empty());
  for (const Json& volume : report["clusters"][0]["volumes"]) {
    SCOPED_TRACE(volume["method"]);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_TRUE(holds(volume, load_point(points.xyz(), i))) << i;
  }
  EXPECT_THAT(result.out, testing::Not(testing::ContainsRegex("nan|inf[^i]|null|-0[],}]")));
}

TEST_F(PcdBv, SameBytesForEveryInstructionSetAndThreadCount) {
  std::istringstream words(run({"--version"}).out.substr(run({"--version"}).out.find("sets:") + 5));
  const std::vector<std::string> common = {"--format", "jsonl", "--volume", "all", "--check"};
  for (const std::vector<std::string>& scene :
       {std::vector<std::string>{"synth:street"}, {"--cluster", "0.4", "--range", "1:60", "synth:street"}}) {
    std::string expected;
    words.clear();
    words.seekg(0);
    for (std::string isa; words >> isa;) {
      for (const std::string threads : {"1", "2"}) {
        SCOPED_TRACE(isa + " with " + threads + " threads");
        std::vector<std::string> arguments = common;
        arguments.insert(arguments.end(), {"--isa", isa, "--threads", threads});
        arguments.insert(arguments.end(), scene.begin(), scene.end());
        const Result result = run(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        if (expected.empty()) expected = result.out;
        EXPECT_EQ(result.out, expected);
      }
    }
    EXPECT_GT(expected.size(), 100u);
  }
}

TEST_F(PcdBv, RealSweepsHoldEveryPoint) {
  const char* data = std::getenv("PCL_BV_DATA");
  if (!data) GTEST_SKIP() << "PCL_BV_DATA is not set";
  const std::string folder(data);
  const Result result = run({"--format", "jsonl", "--volume", "all", "--check", folder + "/lidar_sequence",
                             folder + "/organized", folder + "/objects", folder + "/sensors"});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(PcdBv, UpTurnsUprightBoxesAndOrientedBoxesPassTheCheck) {
  const std::string tile = ascii("tile.pcd", {"0 0 0", "3 4 0", "-4 3 1", "-1 7 2", "1 3 0.5"});
  const Json volumes = run({"--volume", "obb-yaw,obb-lshape,obb-min,obb-pca,obb-dito14", "--up", "-y",
                            "--check", "--format", "jsonl", tile})
                           .json()["clusters"][0]["volumes"];
  ASSERT_EQ(volumes.size(), 5u);
  for (const Json& volume : volumes) {
    EXPECT_EQ(volume["shape"], "obb");
    EXPECT_EQ(volume["outside"], 0);
    EXPECT_GE(volume["half_extents"][0], volume["half_extents"][1]);
  }
  for (const int upright : {0, 1})
    EXPECT_EQ(volumes[upright]["axes"][2], Json::parse("[0,-1,0]")) << volumes[upright];
  for (const int any : {2, 3, 4})
    EXPECT_GE(volumes[any]["half_extents"][1], volumes[any]["half_extents"][2]);
}

TEST_F(PcdBv, QuaternionsOfUprightBoxesAreThoseOfTheirRightHandedAxes) {
  const std::string pole = ascii("pole.pcd", {"0 0 0", "0.2 0.1 4", "0.1 -0.3 1", "-0.1 0.2 3"});
  for (const char* up : {"z", "-z", "x", "-y", "1,2,3"}) {
    const Json volumes = run({"--volume", "obb-yaw,obb-lshape", "--up", up, "--format", "jsonl", pole})
                             .json()["clusters"][0]["volumes"];
    for (const Json& volume : volumes) {
      const auto q = volume["quaternion"].get<std::vector<double>>();
      const Eigen::Matrix3d turn = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
      for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(volume["axes"][axis][k].get<double>(), turn(k, axis), 1e-15) << up << volume;
    }
  }
}

TEST_F(PcdBv, InfoSaysWhatTheCloudIsLike) {
  std::string rows;
  for (int i = 0; i < 40; ++i)
    rows += std::to_string(i * 0.5) + " " + std::to_string(i % 2 * 0.25) + " -2\n";
  std::string text = header(44);
  text.replace(text.find("WIDTH 44\nHEIGHT 1"), 17, "WIDTH 22\nHEIGHT 2");
  const std::string cloud = file("c.pcd", text + rows + "0 0 0\n-0 0 0\nnan 0 0\ninf 0 0\n");
  const Json info = run({"--info", "--format", "jsonl", cloud}).json()["info"];
  EXPECT_EQ(info["min"], Json::parse("[0,0,-2]"));
  EXPECT_EQ(info["max"], Json::parse("[19.5,0.25,-2]"));
  EXPECT_NEAR(info["spacing"], std::sqrt(0.3125), 1e-15);
  EXPECT_EQ(info["organized"], true);
  EXPECT_EQ(info["nonfinite"], 2);
  EXPECT_EQ(info["zero"], 2);
  ASSERT_EQ(info["fields"].size(), 3u);
  EXPECT_EQ(info["fields"][2], Json::parse(R"({"name":"z","type":"F","size":4,"count":1})"));
  const std::string table = run({"--info", cloud}).out;
  EXPECT_THAT(table, testing::HasSubstr("\n  x 0 to 19.5, y 0 to 0.25, z -2 to -2, spacing 0.559, 22 x 2, "
                                        "2 not finite, 2 at 0,0,0\n  fields x:F32 y:F32 z:F32\n"));
}

TEST_F(PcdBv, InfoOfFewOrNoPointsLeavesOutWhatThereIsNot) {
  const Json none = run({"--info", "--format", "jsonl", ascii("none.pcd", {"nan 0 0"})}).json()["info"];
  EXPECT_EQ(none.size(), 4u) << none;
  EXPECT_EQ(none["organized"], false);
  const Json one = run({"--info", "--format", "jsonl", ascii("one.pcd", {"1 2 3"})}).json()["info"];
  EXPECT_FALSE(one.contains("spacing"));
  EXPECT_EQ(one["max"], Json::parse("[1,2,3]"));
  EXPECT_FALSE(run({"--format", "jsonl", at("one.pcd")}).json().contains("info"));
}

}  // namespace
}  // namespace pcl_bv::test
