// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The files that pcd_bv makes: whole or not at all, and where they belong.

#include <gmock/gmock.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "command.h"
#include "devices.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

TEST_F(PcdBv, OutputFileHoldsWhatStandardOutputWould) {
  const std::string cloud = ascii("c.pcd", {"0 0 0", "1 2 3"});
  for (const std::string format : {"text", "json", "jsonl", "csv"}) {
    SCOPED_TRACE(format);
    const std::string expected = run({"--format", format, cloud, cloud}).out;
    const Result result = run({"--format", format, "--output", at("out"), cloud, cloud});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(read_file(at("out")), expected);
  }
}

TEST_F(PcdBv, OutputThatCannotBeWrittenIsStatusOneAndOneLine) {
  const std::string cloud = ascii("c.pcd", {"0 0 0"});
  fs::create_directory(at("folder"));
  for (const std::string& output : {cloud + "/folder/out", at("folder"), cloud + "/out"}) {
    const Result result = run({"--output", output, cloud});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, StartsWith("pcd_bv: " + output + ": "));
    EXPECT_EQ(result.error_lines(), 1u) << result.err;
  }
  EXPECT_TRUE(fs::is_directory(at("folder")));
  EXPECT_TRUE(fs::is_regular_file(cloud));
}

TEST_F(PcdBv, AnOutputInAMissingFolderIsAnErrorThatCreatesNothing) {
  const std::string cloud = ascii("c.pcd", {"0 0 0", "1 2 3"});
  for (const auto& [option, name] : {std::pair{"--output", "no/x"},
                                     {"--partial", "no/folder/x"},
                                     {"--labels", "no/x.pcd"},
                                     {"--mesh", "no/x.ply"},
                                     {"--mesh", "no/x.glb"},
                                     {"--image", "no/x.png"},
                                     {"--view-html", "no/x.html"},
                                     {"--labels", "no/folder/"},
                                     {"--objects", "no/folder"}}) {
    std::vector<std::string> arguments{option, at(name), "--volume", "aabb", cloud};
    if (option == std::string("--objects"))
      arguments.insert(arguments.end(), {"--cluster", "9", "--min-size", "1"});
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 1) << option;
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_THAT(result.err, HasSubstr("no/")) << option;
    EXPECT_FALSE(fs::exists(at("no"))) << option;
  }
  EXPECT_EQ(run({"--output", at("no/x"), cloud}).err,
            "pcd_bv: " + at("no/x") + ": its folder does not exist\n");
}

TEST_F(PcdBv, AFileOfNoFormatIsRefusedBeforeAnyWork) {
  const std::string cloud = ascii("c.pcd", {"0 0 0", "1 2 3"});
  for (const auto& [option, name, reason] : {std::tuple{"--labels", "x.ply", "is no .pcd file"},
                                             {"--labels", "x", "has no suffix such as .pcd"},
                                             {"--mesh", "x", "has no suffix such as .ply"},
                                             {"--image", "x", "has no suffix such as .png"}}) {
    const Result result = run({option, at(name), cloud});
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_EQ(result.err, "pcd_bv: " + std::string(option) + ": '" + at(name) + "' " + reason + "\n");
    EXPECT_FALSE(fs::exists(at(name)));
  }
  fs::create_directory(at("folder.d"));
  for (const std::string folder : {"folder.d", "new/"}) {
    const Result result = run({"--labels", at(folder), "--mesh", at(folder), "--image", at(folder), cloud});
    EXPECT_EQ(result.status, 0) << result.err;
    for (const char* name : {"/c.pcd", "/c.ply", "/c.png"})
      EXPECT_TRUE(fs::is_regular_file(at(folder) + name)) << folder << name;
  }
}

TEST_F(PcdBv, FilesThatCannotBeWrittenLeaveTheReportAndTheOldFiles) {
  const std::string cloud = ascii("c.pcd", {"0 0 0"});
  const std::string blocked = file("blocked", "old");  // a file where a folder would have to be
  for (const auto& [option, name] :
       {std::pair{"--labels", "x.pcd"}, {"--mesh", "x.vtp"}, {"--image", "x.png"}}) {
    SCOPED_TRACE(option);
    const std::string target = blocked + "/" + name;
    const Result result = run({option, target, cloud});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.error_lines(), 1u) << result.err;
    EXPECT_THAT(result.err, StartsWith("pcd_bv: " + target + ": "));
    EXPECT_THAT(result.out, HasSubstr("1 points"));
    EXPECT_EQ(read_file(blocked), "old");
  }
}

TEST_F(PcdBv, FailedInputLeavesOldLabelsAndPicture) {
  const std::string labels = file("l.pcd", "old labels"), image = file("i.png", "old picture");
  const std::string mesh = file("m.ply", "old mesh");
  EXPECT_EQ(run({"--labels", labels, "--image", image, "--mesh", mesh, at("missing.pcd")}).status, 1);
  EXPECT_EQ(read_file(mesh), "old mesh");
  EXPECT_EQ(read_file(labels), "old labels");
  EXPECT_EQ(read_file(image), "old picture");
}

TEST_F(PcdBv, SeveralInputsPutTheirFilesIntoANewFolder) {
  ascii("in/a.pcd", {"0 0 0", "1 2 3"});
  ascii("in/b.c.pcd", {"0 0 0", "1 2 3"});
  const Result result = run({"--labels", at("labels"), "--image", at("images"), "--mesh", at("meshes/"),
                             at("in"), "synth:box:500:2"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const std::string stem : {"a", "b.c", "box-500-2"}) {
    EXPECT_GT(read_pcd(at("labels/" + stem + ".pcd")).size(), 0u);
    EXPECT_THAT(read_file(at("images/" + stem + ".png")), StartsWith("\x89PNG"));
    EXPECT_THAT(read_file(at("meshes/" + stem + ".ply")), StartsWith("ply\n"));
  }
}

TEST_F(PcdBv, MeshIsOfTheFormatThatItsNameSays) {
  const std::string a = ascii("a.pcd", {"0 0 0", "1 2 3"}), b = ascii("b.pcd", {"0 0 0"});
  EXPECT_EQ(run({"--mesh", at("m.VTP"), a}).status, 0);
  EXPECT_THAT(read_file(at("m.VTP")), HasSubstr("<VTKFile type=\"PolyData\""));
  EXPECT_EQ(run({"--mesh", at("m.ply"), a}).status, 0);
  EXPECT_THAT(read_file(at("m.ply")), StartsWith("ply\n"));
  EXPECT_EQ(run({"--mesh", at("frames.vtp"), a, b}).status, 0);  // a folder
  EXPECT_THAT(read_file(at("frames.vtp/b.vtp")), HasSubstr("<VTKFile type=\"PolyData\""));
}

TEST_F(PcdBv, MeshHoldsAllVolumesOfAllClusters) {
  const Result result = run({"--cluster", "1", "--min-size", "1", "--volume", "aabb,dop26", "--mesh",
                             at("m.ply"), ascii("a.pcd", {"0 0 0", "0.5 0.5 0.5", "9 9 9", "9.5 9.5 9.5"})});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(read_file(at("m.ply")), HasSubstr("comment method 0 is aabb\ncomment method 1 is dop26\n"));
  const RawCloud vertices = read_cloud(at("m.ply"));
  EXPECT_EQ(vertices.size(), 2 * (8 + 2u));  // each k-DOP of two points on a diagonal is a line
}

TEST_F(PcdBv, MeshOverAnInputIsRefused) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  const std::string cloud = file("in/a.ply", header);
  for (const std::string& target : {cloud, at("in")}) {
    EXPECT_EQ(run({"--mesh", target, cloud}).status, 2) << target;
    EXPECT_EQ(read_file(cloud), header);
  }
}

const std::string kCsvHeading =
    "file,cluster,points,method,cx,cy,cz,sx,sy,sz,qx,qy,qz,qw,radius,volume,length,width,height,yaw\n";

TEST_F(PcdBv, CsvIsAHeadingAndALineForEachVolumeOfEachInput) {
  const std::string a = ascii("a,1.pcd", {"0 0 0", "1 2 3"}), b = ascii("b.pcd", {"nan 0 0"});
  const Result result = run({"--format", "csv", "--volume", "aabb,dop6", a, at("missing.pcd"), b});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, StartsWith("file,cluster,points,method,cx,cy,cz,sx,sy,sz,qx,qy,qz,qw,radius,volume,"
                                     "length,width,height,yaw\n\"" +
                                     a + "\",0,2,aabb,0.5,1,1.5,1,2,3,,,,,,6,,,,\n"));
  EXPECT_THAT(result.out,
              testing::EndsWith(b + ",0,0,aabb,,,,,,,,,,,,,,,,\n" + b + ",0,0,dop6,,,,,,,,,,,,,,,,\n"));
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 5);
}

TEST_F(PcdBv, CsvOfNothingThatCanBeReadIsOnlyTheHeading) {
  const Result result = run({"--format", "csv", at("missing.pcd")});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(
      result.out,
      "file,cluster,points,method,cx,cy,cz,sx,sy,sz,qx,qy,qz,qw,radius,volume,length,width,height,yaw\n");
}

TEST_F(PcdBv, FolderOfOneCloudPutsItsFilesIntoAFolderToo) {
  ascii("in/a.pcd", {"0 0 0"});
  EXPECT_EQ(run({"--labels", at("labels"), at("in")}).status, 0);
  EXPECT_TRUE(fs::is_regular_file(at("labels/a.pcd")));
}

TEST_F(PcdBv, TwoResultsForOneFileAreRefusedBeforeAnyWork) {
  const std::string a = ascii("1/x.pcd", {"0 0 0"}), b = ascii("2/x.pcd", {"1 1 1"});
  const Result result = run({"--labels", at("labels"), a, b});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.error_lines(), 1u) << result.err;
  EXPECT_FALSE(fs::exists(at("labels")));
  EXPECT_EQ(run({"--output", at("same.pcd"), "--labels", at("same.pcd"), a}).status, 2);
}

TEST_F(PcdBv, PictureIsOfTheFormatAndFromTheSideAsked) {
  const std::string box = "synth:box:500:2";
  EXPECT_EQ(run({"--image", at("iso.png"), box}).status, 0);
  for (const std::string view : {"top", "front", "side"}) {
    EXPECT_EQ(run({"--image", at(view + ".png"), "--view", view, box}).status, 0);
    EXPECT_NE(read_file(at(view + ".png")), read_file(at("iso.png")));
  }
  EXPECT_NE(read_file(at("top.png")), read_file(at("front.png")));
  EXPECT_NE(read_file(at("side.png")), read_file(at("front.png")));
  EXPECT_EQ(run({"--image", at("a.svg"), box}).status, 0);
  EXPECT_THAT(read_file(at("a.svg")), HasSubstr("<svg"));
  EXPECT_EQ(run({"--image", at("all.svg"), box, "synth:box:500:3"}).status, 0);  // a folder
  EXPECT_THAT(read_file(at("all.svg/box-500-3.svg")), HasSubstr("<svg"));
}

TEST_F(PcdBv, PictureTurnsUpUp) {
  const std::string box = "synth:box:500:2";
  EXPECT_EQ(run({"--image", at("z.png"), box}).status, 0);
  EXPECT_EQ(run({"--up", "-y", "--image", at("y.png"), box}).status, 0);
  EXPECT_TRUE(read_file(at("y.png")) != read_file(at("z.png")));
}

TEST_F(PcdBv, PictureShowsTheIdOfEachClusterAndTheNamesOfTheMethods) {
  const std::string cloud =
      ascii("c.pcd", {"1 1 1", "1 1.1 1", "1 1 1.1", "9 9 1", "9 9.1 1", "20 1 1", "20 1.1 1"});
  const auto letters = [&](const std::string& methods, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--volume", methods,     "--view", "top",
                                          "--image",  at("c.svg"), cloud};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).status, 0);
    const std::string svg = read_file(at("c.svg"));
    std::size_t n = 0;
    for (std::size_t i = svg.find("#glyph"); i != std::string::npos; i = svg.find("#glyph", i + 1))
      ++n;
    return n;
  };
  const std::vector<std::string> clusters = {"--cluster", "0.5", "--min-size", "1"};
  const std::size_t plain = letters("aabb", {});
  EXPECT_EQ(letters("aabb", clusters), plain + 3);
  EXPECT_EQ(letters("aabb,sphere", clusters), plain + 3 +
                                                  std::string("aabb"
                                                              "sphere-exact")
                                                      .size());
}

TEST_F(PcdBv, PictureIsTheSameEachTime) {
  const std::vector<std::string> common = {"--range",  "1:60", "--cluster",         "0.5",
                                           "--volume", "all",  "synth:street:16000"};
  const auto picture = [&](const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--image", at(name)});
    arguments.insert(arguments.end(), common.begin(), common.end());
    EXPECT_EQ(run(arguments).status, 0);
    return read_file(at(name));
  };
  const std::string first = picture("a.png", {"--isa", "scalar", "--threads", "1"});
  EXPECT_THAT(first, StartsWith("\x89PNG"));
  EXPECT_EQ(picture("b.png", {"--threads", "2"}), first);
}

TEST_F(PcdBv, OutputToADeviceLeavesTheDevice) {
  const std::string cloud = ascii("c.pcd", {"0 0 0"});
  const fs::path null = device_in(at(""), Device::null);
  if (null.empty()) GTEST_SKIP() << "no device can be made";
  EXPECT_EQ(run({"--output", null.string(), cloud}).status, 0);
  EXPECT_TRUE(fs::is_character_file(null));
}

}  // namespace
}  // namespace pcl_bv::test
