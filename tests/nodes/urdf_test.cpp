// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stream/rig/urdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "folder.h"
#include "german_locale.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/nodes/frame_source.h"

namespace pcl_bv::detail {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Vector = Eigen::Vector3d;

constexpr const char* kRobot = R"(<?xml version="1.0"?>
<robot name="r">
  <link name="base_link">
    <collision><origin xyz="0 0 0.5"/><geometry><box size="2 1 1"/></geometry></collision>
  </link>
  <link name="mast"><collision><geometry><cylinder radius="0.1" length="2"/></geometry></collision></link>
  <link name="lidar"><collision><geometry><sphere radius="0.2"/></geometry></collision></link>
  <link name="wheel"><collision><geometry><mesh filename="package://robot/wheel.stl" scale="2 2 2"/></geometry></collision></link>
  <joint name="m" type="fixed"><parent link="base_link"/><child link="mast"/><origin xyz="1 0 2" rpy="0 0 1.5707963267948966"/></joint>
  <joint name="l" type="fixed"><parent link="mast"/><child link="lidar"/><origin xyz="0.5 0 0"/></joint>
  <joint name="w" type="continuous"><parent link="base_link"/><child link="wheel"/><origin xyz="0 1 0"/></joint>
</robot>)";

class UrdfFile : public Folder {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  std::string refusal(const std::string& text) const {
    try {
      read_urdf(write("bad.urdf", text));
    } catch (const IoError& error) {
      return error.what();
    }
    return "none";
  }
};

// A tetrahedron as a binary STL, and as a text.
std::string stl(bool binary) {
  const float corners[4][3][3] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                  {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                                  {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                  {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::string text = "solid s\n", bytes = "solid" + std::string(75, ' ') + std::string("\4\0\0\0", 4);
  for (const auto& triangle : corners) {
    bytes.append(12, '\0').append(reinterpret_cast<const char*>(triangle), sizeof triangle).append(2, '\0');
    text += "facet normal 0 0 0\nouter loop\n";
    for (const auto& corner : triangle)
      text += "vertex " + std::to_string(corner[0]) + ' ' + std::to_string(corner[1]) + ' ' +
              std::to_string(corner[2]) + '\n';
    text += "endloop\nendfacet\n";
  }
  return binary ? bytes : text + "endsolid s\n";
}

TEST_F(UrdfFile, GivesItsFixedJointsAsTransforms) {
  Transforms transforms;
  read_urdf(write("robot.urdf", kRobot)).add_joints(transforms);
  EXPECT_TRUE(
      transforms.find("base_link", "lidar", 0).pose->translation().isApprox(Vector(1, 0.5, 2), 1e-12));
  EXPECT_FALSE(transforms.find("base_link", "wheel", 0).pose);  // it moves
}

TEST_F(UrdfFile, AndItsMeshesDoNotDependOnTheLocale) {
  write("t.obj", "v 1.250 0.5 -2.125\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
  const test::GermanLocale german;
  EXPECT_EQ(read_mesh_vertices(path_ / "t.obj")[0], Vector(1.25, 0.5, -2.125));
  const Urdf urdf = read_urdf(write("robot.urdf",
                                    "<robot><joint name='j' type='fixed'><parent link='a'/><child link='b'/>"
                                    "<origin xyz='1.250 0.5 -2.125'/></joint></robot>"));
  EXPECT_EQ(Vector(urdf.joints[0].pose.translation()), Vector(1.25, 0.5, -2.125));
}

TEST_F(UrdfFile, GivesItsCollisionShapesInAnyLinksFrame) {
  write("robot/wheel.stl", stl(true));
  const Urdf urdf = read_urdf(write("robot/urdf/robot.urdf", kRobot));
  EXPECT_THAT(urdf.warnings, IsEmpty());
  std::vector<std::string> problems;
  const std::vector<AnyVolume> volumes = urdf.volumes_in("base_link", problems);
  ASSERT_EQ(volumes.size(), 4U);
  EXPECT_THAT(problems, ElementsAre(HasSubstr("joint w moves")));
  EXPECT_NEAR(std::get<Obb>(volumes[0]).volume(), 2, 1e-9);
  EXPECT_TRUE(std::get<Obb>(volumes[0]).contains(Vector(0.9, 0.4, 0.9)));
  EXPECT_FALSE(std::get<Obb>(volumes[0]).contains(Vector(0.9, 0.4, -0.1)));
  EXPECT_TRUE(std::get<Cylinder>(volumes[1]).contains(Vector(1, 0.05, 2.9)));
  EXPECT_TRUE(std::get<Sphere>(volumes[2]).contains(Vector(1, 0.6, 2.1)));
  // The tetrahedron, twice as large, at (0, 1, 0).
  EXPECT_TRUE(std::get<Hull>(volumes[3]).contains(Vector(0.1, 1.1, 1.7)));
  EXPECT_FALSE(std::get<Hull>(volumes[3]).contains(Vector(1.1, 2.1, 1)));
  const std::vector<AnyVolume> from_lidar = urdf.volumes_in("lidar", problems);
  EXPECT_TRUE(std::get<Sphere>(from_lidar[2]).contains(Vector(0, 0, 0)));
  EXPECT_THROW(urdf.volumes_in("nowhere", problems), IoError);
}

TEST_F(UrdfFile, LeavesOutMeshesThatCannotBeReadWithAWarning) {
  const Urdf urdf = read_urdf(write("robot.urdf", kRobot));
  EXPECT_EQ(urdf.shapes.size(), 3U);
  EXPECT_THAT(urdf.warnings, ElementsAre(HasSubstr("link wheel: package://robot/wheel.stl: not found")));
}

TEST_F(UrdfFile, LeavesOutOtherGeometriesWithAWarning) {
  const Urdf urdf = read_urdf(write("robot.urdf",
                                    "<robot><link name='a'>\n<collision><geometry><capsule radius='1'/>"
                                    "</geometry></collision></link></robot>"));
  EXPECT_THAT(urdf.shapes, IsEmpty());
  EXPECT_THAT(urdf.warnings, ElementsAre(HasSubstr("link a: line 2: the geometry is not a box, sphere")));
}

TEST_F(UrdfFile, IsReadWithoutShapesWhereOnlyItsJointsAreUsed) {
  const Urdf urdf = read_urdf(write("robot.urdf", kRobot), UrdfContent::joints);
  EXPECT_EQ(urdf.joints.size(), 3U);
  EXPECT_THAT(urdf.shapes, IsEmpty());
  EXPECT_THAT(urdf.warnings, IsEmpty());
}

TEST_F(UrdfFile, MayNameMeshesInTextInObjAndByPath) {
  for (const auto& [name, content] : {std::pair<std::string, std::string>{"t.stl", stl(false)},
                                      {"t.obj", "v 0 0 0\nv 1 0 0\nvn 5 5 5\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"}}) {
    EXPECT_EQ(read_mesh_vertices(write(name, content)).size(), name == "t.obj" ? 4U : 12U);
    const Urdf urdf =
        read_urdf(write("robot.urdf", "<robot><link name='a'><collision><geometry><mesh filename='" + name +
                                          "'/></geometry></collision></link></robot>"));
    ASSERT_EQ(urdf.shapes.size(), 1U);
    EXPECT_NEAR(std::get<Hull>(urdf.shapes[0].volume).volume(), 1.0 / 6, 1e-6);
  }
  EXPECT_THROW(read_mesh_vertices(write("t.dae", "x")), IoError);
  EXPECT_THROW(read_mesh_vertices(write("e.stl", "")), IoError);
  for (const char* const wrong : {"v 1 2\n", "v 1 2 x\n", "v 1 nan 2\n", "v 1 2 1e999\n"})
    EXPECT_THROW(read_mesh_vertices(write("e.obj", wrong)), IoError) << wrong;
}

TEST_F(UrdfFile, IsRejectedWithItsFileAndLine) {
  EXPECT_THAT(refusal("no xml"), HasSubstr("bad.urdf: not XML"));
  EXPECT_THAT(refusal("<sdf/>"), HasSubstr("no element <robot>"));
  EXPECT_THAT(refusal("<robot>\n<joint name='j' type='fixed'><parent link='a'/></joint></robot>"),
              HasSubstr("line 2: a joint has no parent or no child"));
  EXPECT_THAT(
      refusal("<robot><link name='a'><collision><geometry><sphere/></geometry></collision></link></robot>"),
      HasSubstr("radius is not above 0"));
  EXPECT_THAT(refusal("<robot><link name='a'><collision><geometry><sphere "
                      "radius='nan'/></geometry></collision></link></robot>"),
              HasSubstr("radius 'nan' is not a number"));
  EXPECT_THAT(refusal("<robot><link name='a'><collision><origin xyz='1 2'/><geometry><mesh filename='a.stl'/>"
                      "</geometry></collision></link></robot>"),
              HasSubstr("xyz '1 2' is not 3 numbers"));
  std::string deep = "<robot>";
  for (int i = 0; i < 100'000; ++i)
    deep += "<a>";
  EXPECT_THAT(refusal(deep), HasSubstr("not XML"));
}

TEST_F(UrdfFile, CutOffAnywhereGivesAnErrorOrARobotButNoCrash) {
  const std::string robot = kRobot;
  for (std::size_t size = 0; size < robot.size(); size += 7)
    EXPECT_NE(refusal(robot.substr(0, size)), "none") << size;
}

TEST_F(UrdfFile, BecomesTheRegionOfTheRobotsBody) {
  RigConfig rig;
  rig.frame = "base_link";
  rig.urdf = write("robot.urdf", kRobot).string();
  std::vector<std::string> warnings;
  EXPECT_FALSE(robot_body(rig, warnings));
  rig.self_filter = 0.05;
  const std::optional<RegionConfig> body = robot_body(rig, warnings);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->volumes.size(), 3U);
  EXPECT_EQ(body->padding, 0.05);
  EXPECT_FALSE(body->keep);
  EXPECT_THAT(warnings, Contains(HasSubstr("wheel")));
  rig.frame = "moon";
  EXPECT_THROW(robot_body(rig, warnings), IoError);
}

}  // namespace
}  // namespace pcl_bv::detail
