// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Inputs, good and bad: each bad one is one line, an error object and status 1, and the others are done.

#include <gmock/gmock.h>

#include "command.h"

namespace pcl_bv::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(PcdBv, EveryBrokenInputIsOneLineAndTheOthersAreDone) {
  const std::string good = ascii("good.pcd", {"1 2 3", "4 5 7"});
  const std::string header3 = header(3);
  std::filesystem::create_directory(at("folder"));
  std::filesystem::create_directory(at("folder.pcd"));
  std::filesystem::create_symlink(at("nowhere"), at("dangling.pcd"));
  const auto with = [&](std::string text, std::string_view from, std::string_view to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::vector<std::string> broken = {
      at("missing.pcd"),
      at("folder"),
      at("folder.pcd"),
      at("dangling.pcd"),
      file("empty.pcd", ""),
      file("text.pcd", "this is not a cloud\n"),
      file("header.pcd", header3.substr(0, 40)),
      file("no-data.pcd", header(3, "binary")),
      file("short.pcd", header(3, "binary") + std::string(35, '\0')),
      file("short-ascii.pcd", header3 + "1 2 3\n4 5 6\n"),
      file("bad-number.pcd", header3 + "1 2 3\n4 five 6\n7 8 9\n"),
      file("huge.pcd", header(4000000000000000000, "binary") + std::string(36, '\0')),
      file("negative.pcd", with(header3, "WIDTH 3", "WIDTH -3") + "1 2 3\n1 2 3\n1 2 3\n"),
      file("mismatch.pcd", with(header3, "POINTS 3", "POINTS 4") + "1 2 3\n1 2 3\n1 2 3\n"),
      file("no-z.pcd", with(header3, "FIELDS x y z", "FIELDS x y w") + "1 2 3\n1 2 3\n1 2 3\n"),
      file("integers.pcd", with(header3, "TYPE F F F", "TYPE I I I") + "1 2 3\n1 2 3\n1 2 3.5\n"),
      file("packed.pcd", header(3, "binary_compressed") + "junk"),
      file("mesh.ply", "ply\n"),
      file("cut.ply",
           "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\nend_header\n" +
               std::string(35, '\0')),
      file("integers.ply",
           "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\n"
           "property int z\nend_header\n1 2 nan\n"),
      file("sweep.bin", std::string(31, '\0')),
      file("empty.bin", ""),
      "synth:nonsense",
      "synth:street:0",
      "synth:sphere:10:x",
  };
  for (const std::string& input : broken) {
    SCOPED_TRACE(input);
    const Result result = run({"--format", "json", input, good});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.error_lines(), 2u) << result.err;  // and the summary
    EXPECT_THAT(result.err, StartsWith("pcd_bv: " + input + ": "));
    const Json reports = result.json();
    ASSERT_EQ(reports.size(), 2u);
    EXPECT_EQ(reports[0]["schema"], 1);
    EXPECT_EQ(reports[0]["file"], input);
    EXPECT_EQ(reports[0].size(), 3u) << reports[0];
    EXPECT_EQ(result.problems(), "pcd_bv: " + input + ": " + reports[0]["error"].get<std::string>() + "\n");
    EXPECT_EQ(reports[1]["points"], 2);
  }
}

TEST_F(PcdBv, OtherInputsAreDoneAfterABadOneInText) {
  const std::string a = ascii("a.pcd", {"1 2 3"}), b = ascii("b.pcd", {"4 5 6"});
  const Result result = run({a, at("missing.pcd"), b});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr(a + ": 1 points"));
  EXPECT_THAT(result.out, HasSubstr(b + ": 1 points"));
}

TEST_F(PcdBv, FolderIsReadInNaturalOrder) {
  for (const char* name : {"frames/scan10.pcd", "frames/scan9.pcd", "frames/scan100.pcd"})
    ascii(name, {"1 2 3"});
  file("frames/notes.txt", "no cloud");
  file("frames/scan11.bin", std::string(16, '\0'));
  const Json reports = run({"--format", "json", at("frames")}).json();
  ASSERT_EQ(reports.size(), 4u);
  EXPECT_EQ(reports[0]["file"], at("frames/scan9.pcd"));
  EXPECT_EQ(reports[1]["file"], at("frames/scan10.pcd"));
  EXPECT_EQ(reports[2]["file"], at("frames/scan11.bin"));
  EXPECT_EQ(reports[3]["file"], at("frames/scan100.pcd"));
}

TEST_F(PcdBv, SubfoldersThatAreNotReadAreSaid) {
  const std::string folder = at("frames");
  ascii("frames/a.pcd", {"1 2 3"});
  fs::create_directory(at("frames/.git"));
  EXPECT_EQ(run({folder}).err, "");
  ascii("frames/1/b.pcd", {"1 2 3"});
  EXPECT_EQ(run({folder}).err, "pcd_bv: " + folder + ": 1 subfolder is not read\n");
  fs::create_directory(at("frames/2.pcd"));
  const Result result = run({folder, "--format", "json"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "pcd_bv: " + folder + ": 2 subfolders are not read\n");
  EXPECT_EQ(result.json().size(), 1U);
}

TEST_F(PcdBv, EveryFormatGivesTheSameVolumes) {
  const float points[2][4] = {{1, 2, 3, 0.5f}, {4, -5, 6.25f, 1}};
  const std::string pcd = ascii("c.pcd", {"1 2 3", "4 -5 6.25"});
  const std::string bin = file("c.bin", {reinterpret_cast<const char*>(points), sizeof points});
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 2\n",
                    rows = "end_header\n1 2 3\n4 -5 6.25\n";
  const std::string ply =
      file("c.ply", header + "property float x\nproperty float y\nproperty float z\n" + rows);
  const std::string doubles =
      file("d.PLY", header + "property double x\nproperty double y\nproperty double z\n" + rows);
  const Result result = run({"--format", "json", "--volume", "all", "--check", pcd, bin, ply, doubles});
  EXPECT_EQ(result.status, 0) << result.err;
  const Json reports = result.json();
  ASSERT_EQ(reports.size(), 4u);
  for (const Json& report : reports)
    EXPECT_EQ(report["clusters"], reports[0]["clusters"]) << report["file"];
}

TEST_F(PcdBv, DoublesAreTakenAtTheirWord) {
  const std::string cloud =
      file("d.ply",
           "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
           "property double z\nend_header\n5000000.123456789 0 1e-300\n5000001 1 1e60\n");
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--range", "0:inf"}}) {
    std::vector<std::string> arguments = {"--format", "jsonl", "--volume", "all", "--check", cloud};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.json()["clusters"][0]["volumes"][0]["min"], Json::parse("[5000000.123456789,0,1e-300]"));
  }
}

TEST_F(PcdBv, FieldsOfEveryFormatAreKeptWithTheLabels) {
  const std::string cloud =
      file("c.ply",
           "ply\nformat ascii 1.0\nelement vertex 1\nproperty uchar red\nproperty double x\n"
           "property double y\nproperty double z\nend_header\n200 1 2 3\n");
  EXPECT_EQ(run({"--labels", at("l.pcd"), cloud}).status, 0);
  EXPECT_THAT(read_file(at("l.pcd")), HasSubstr("FIELDS red x y z label\nSIZE 1 8 8 8 4\nTYPE U F F F U\n"));
  EXPECT_EQ(run({at("l.pcd")}).status, 0);
}

TEST_F(PcdBv, SyntheticSceneIsTheSameEachTime) {
  const Result first = run({"--format", "jsonl", "synth:gauss:5000:7"});
  EXPECT_EQ(first.status, 0);
  EXPECT_EQ(first.json()["points"], 5000);
  EXPECT_EQ(first.json()["file"], "synth:gauss:5000:7");
  EXPECT_EQ(run({"--format", "jsonl", "synth:gauss:5000:7"}).out, first.out);
  EXPECT_NE(run({"--format", "jsonl", "synth:gauss:5000:8"}).json()["clusters"], first.json()["clusters"]);
}

TEST_F(PcdBv, CloudWithNothingFiniteHasEmptyVolumes) {
  const std::string bad = ascii("bad.pcd", {"nan 1 2", "inf 0 0", "nan nan nan"});
  const Result result = run({"--format", "jsonl", "--check", "--volume", "all", bad});
  EXPECT_EQ(result.status, 0);
  const Json report = result.json();
  EXPECT_EQ(report["counts"]["nonfinite"], 3);
  ASSERT_EQ(report["clusters"].size(), 1u);
  EXPECT_EQ(report["clusters"][0]["points"], 0);
  for (const Json& volume : report["clusters"][0]["volumes"]) {
    EXPECT_EQ(volume["empty"], true);
    EXPECT_EQ(volume["outside"], 0);
    EXPECT_EQ(volume.size(), 4u) << volume;
  }
  EXPECT_EQ(run({bad}).status, 0);
  EXPECT_EQ(run({"--image", at("bad.png"), bad}).status, 0);
  EXPECT_TRUE(run({"--format", "jsonl", "--cluster", "1", bad}).json()["clusters"].empty());
}

TEST_F(PcdBv, CloudWithoutPointsIsNoError) {
  const std::string none = ascii("none.pcd", {});
  const Result result = run({"--format", "jsonl", none});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["clusters"][0]["volumes"][0]["empty"], true);
  EXPECT_EQ(run({"--origin", "auto", "--cluster", "1", none}).status, 0);
}

TEST_F(PcdBv, InvalidUtf8InANameIsReplacedNotFatal) {
  const std::string odd = ascii("od\xff.pcd", {"1 2 3"});
  const Result result = run({"--format", "jsonl", odd});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.json()["file"].get<std::string>(), HasSubstr("od\xEF\xBF\xBD.pcd"));
}

TEST_F(PcdBv, RangeKeepsBothEndsAndCountsTheRest) {
  const std::string cloud =
      ascii("c.pcd", {"0 0 0", "3 4 0", "0 0 4.9999", "0 -10 0", "0 0 10.0001", "nan 5 5"});
  const Json report = run({"--format", "jsonl", "--volume", "aabb", "--range", "5:10", cloud}).json();
  EXPECT_EQ(report["points"], 6);
  EXPECT_EQ(report["counts"]["nonfinite"], 1);
  EXPECT_EQ(report["counts"]["range"], 3);
  EXPECT_EQ(report["clusters"][0]["points"], 2);
  EXPECT_EQ(report["clusters"][0]["volumes"][0]["min"], Json::parse("[0,-10,0]"));
  EXPECT_EQ(report["clusters"][0]["volumes"][0]["max"], Json::parse("[3,4,0]"));
}

TEST_F(PcdBv, RangeThatDropsNothingChangesNoVolume) {
  const Json all = run({"--format", "jsonl", "synth:street:6400"}).json();
  const Json ranged = run({"--format", "jsonl", "--range", "0:inf", "synth:street:6400"}).json();
  EXPECT_EQ(all, ranged);
}

}  // namespace
}  // namespace pcl_bv::test
