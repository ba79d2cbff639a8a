// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Names and settings that users mistype, and recordings that were cut off.

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "command.h"

namespace pcl_bv::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Mistakes : public PcdBv {
 protected:
  Result stream(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--rate", "max"});
    return run(arguments, {.program = "bv_stream"});
  }
  Result frames_to(const std::vector<std::string>& sinks, std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.begin(), {"--source", "synth:street-sequence:1"});
    for (const std::string& sink : sinks)
      arguments.insert(arguments.end(), {"--sink", sink});
    return stream(std::move(arguments));
  }
  std::string rig() const {
    EXPECT_EQ(run({"rig:12", at("rig.mcap")}, {.program = "synth"}).status, 0);
    return at("rig.mcap");
  }
};

// In the folder of the test: the names of files that do not exist yet are relative.
TEST_F(Mistakes, OneFileUnderTwoSpellingsIsRefusedForTwoResults) {
  const std::string cloud = ascii("in.pcd", {"1 2 3", "4 5 6"});
  const fs::path before = fs::current_path();
  fs::current_path(at(""));
  fs::create_directory("other");
  for (const auto& [one, other] : {std::pair{"x.pcd", "./x.pcd"}, {"x.pcd", "other/../x.pcd"}}) {
    const Result twice = run({"--cluster", "1", "--labels", one, "--output", other, cloud});
    EXPECT_EQ(twice.status, 2) << one << ' ' << other;
    EXPECT_THAT(twice.err, HasSubstr("more than one result would be written to this file"));
  }
  const Result whole = run({"--cluster", "1", "--labels", "x.pcd", "--output", at("x.pcd"), cloud});
  EXPECT_EQ(whole.status, 2);
  EXPECT_EQ(frames_to({"jsonl:a", "csv:./a"}).status, 2);
  EXPECT_EQ(frames_to({"jsonl:a"}, {"--stats", "./a"}).status, 2);
  EXPECT_EQ(frames_to({"vtp:w", "vtp:./w"}).status, 2);
  EXPECT_EQ(frames_to({"jsonl:-", "csv:-"}).status, 2);
  fs::create_symlink("target", at("link"));
  EXPECT_EQ(frames_to({"jsonl:link", "csv:target"}).status, 2);
  fs::current_path(before);
  EXPECT_FALSE(fs::exists(at("x.pcd")));
  EXPECT_FALSE(fs::exists(at("a")));
}

TEST_F(Mistakes, AHardLinkToAnInputIsNotWrittenInPlace) {
  const std::string cloud = ascii("in.pcd", {"1 2 3", "4 5 6"}), before = read_file(cloud);
  fs::create_hard_link(cloud, at("hard"));
  for (const char* sink : {"jsonl:", "csv:", "kitti:", "mcap:"}) {
    const Result result =
        run({"--source", cloud, "--rate", "max", "--sink", sink + at("hard")}, {.program = "bv_stream"});
    EXPECT_EQ(result.status, 2) << sink;
    EXPECT_THAT(result.err, HasSubstr("is an input and would be overwritten"));
    EXPECT_EQ(read_file(cloud), before);
  }
}

TEST_F(Mistakes, AnOutputHasOneProgramThatWritesIt) {
  const std::vector<std::string> sinks = {"jsonl:" + at("a"),   "csv:" + at("b"),  "mcap:" + at("c"),
                                          "rosbag2:" + at("d"), "vtp:" + at("e"),  "image:" + at("f"),
                                          "labels:" + at("g"),  "kitti:" + at("h")};
  std::vector<std::string> first{"--source", "synth:street-sequence:2", "--rate", "0.001"};
  for (const std::string& sink : sinks)
    first.insert(first.end(), {"--sink", sink});
  const auto others = [&](int process) {
    while (read_file(at("a")).empty() || !fs::exists(at("g/frame000000.pcd")) || read_file(at("b")).empty())
      ::kill(process, 0) == 0 ? void(::usleep(10'000)) : std::abort();
    const std::string before = read_file(at("a"));
    for (const std::string& sink : sinks) {
      const Result second = frames_to({"jsonl:" + at("z"), sink});
      EXPECT_EQ(second.status, 1) << sink;
      EXPECT_EQ(second.error_lines(), 1U) << second.err;
      EXPECT_THAT(second.err, testing::StartsWith("bv_stream: " + sink + ": locked: another program "));
      EXPECT_FALSE(fs::exists(at("z")));
    }
    EXPECT_EQ(read_file(at("a")), before);
    ::kill(process, SIGKILL);
  };
  run(first, {.program = "bv_stream", .meanwhile = others});
  for (const std::string& sink : sinks)
    EXPECT_EQ(frames_to({sink}).status, 0) << sink;
}

TEST_F(Mistakes, ADashIsNoFile) {
  const std::string cloud = ascii("in.pcd", {"1 2 3", "4 5 6"});
  for (const Result& result :
       {run({"--output", "-", cloud}), run({"--partial", "-", "--volume", "aabb", cloud}),
        run({"street", "-"}, {.program = "synth"}), frames_to({}, {"--stats", "-"})}) {
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("-: is not a file; use /dev/stdout for standard output"));
  }
  for (const char* sink : {"mcap:-", "rosbag2:-", "vtp:-"})
    EXPECT_THAT(frames_to({sink}).err, HasSubstr("only jsonl, csv and kitti write to standard output"))
        << sink;
  EXPECT_THAT(run({"--image", "-", cloud}).err, HasSubstr("-: is not a file"));
  EXPECT_EQ(frames_to({"csv:-"}).status, 0);
  EXPECT_FALSE(fs::exists("-"));
}

TEST_F(Mistakes, AMistypedOptionOfASinkIsNoPartOfItsName) {
  const Result point = frames_to({"mcap:" + at("m.mcap") + ",point"});
  EXPECT_EQ(point.status, 2);
  EXPECT_THAT(point.err, HasSubstr("mcap: 'point' is not one of its options [,points]"));
  EXPECT_EQ(frames_to({"vtp:" + at("v") + ",nav"}).status, 2);
  EXPECT_EQ(frames_to({"mcap:" + at("a,2026.mcap")}).status, 0);
  EXPECT_TRUE(fs::exists(at("a,2026.mcap")));
}

TEST_F(Mistakes, LabelsOfKittiNeedUprightBoxes) {
  const std::string sink = "kitti:" + at("k.txt");
  for (const char* method : {"sphere", "obb-min"}) {
    const Result result = frames_to({sink}, {"--volume", method});
    EXPECT_EQ(result.status, 2) << method;
    EXPECT_THAT(result.err, HasSubstr("--sink kitti: needs boxes: --volume obb-yaw, obb-lshape or aabb"));
  }
  EXPECT_THAT(frames_to({sink}, {"--up", "x", "--ground", "none"}).err, HasSubstr("so --up must be z"));
  EXPECT_EQ(frames_to({sink}, {"--volume", "aabb"}).status, 0);
}

TEST_F(Mistakes, ARecordingThatIsNotThereIsNamedAlsoWithATopic) {
  for (const char* name : {"gone.mcap", "gone.bag", "gone.pcap", "gone_folder"}) {
    const Result result = stream({"--source", at(name), "--topic", "/points"});
    EXPECT_EQ(result.status, 1) << name;
    EXPECT_THAT(result.err, HasSubstr(std::string(name) + ": no such file or ")) << name;
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
  }
  const Result other = stream({"--source", file("a.mcap", "VERSION .7\n"), "--topic", "/points"});
  EXPECT_EQ(other.status, 1);
  EXPECT_THAT(other.err, HasSubstr("is no recording that can be read"));
}

TEST_F(Mistakes, ARecordingThatIsCutOffBeforeItsCloudsIsDamaged) {
  const std::string whole = read_file(rig());
  const std::string start = file("start.mcap", std::string_view(whole).substr(0, 20));
  for (const Result& result :
       {run({"--topic", "/front/points", start}), stream({"--source", start, "--topic", "/front/points"})}) {
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("start.mcap: no topic can be read: "));
  }
  const std::string half = file("half.mcap", std::string_view(whole).substr(0, 100'000));
  const Result streamed = stream({"--source", half, "--topic", "/front/points"});
  EXPECT_EQ(streamed.status, 1) << streamed.err;
  EXPECT_THAT(streamed.err, HasSubstr("half.mcap: no cloud"));
}

TEST_F(Mistakes, TheSameProblemOfAllFramesIsListedTenTimes) {
  const Result result = stream({"--source", rig(), "--topic", "/front/points", "--class", "foo"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.error_lines(), 11U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("more frames have this problem: there is no field 'foo'"));
  EXPECT_EQ(run({"street-sequence:12", at("sweeps")}, {.program = "synth"}).status, 0);
  EXPECT_EQ(stream({"--source", at("sweeps"), "--class", "foo"}).error_lines(), 11U);
  const Result nowhere = stream({"--source", at("rig.mcap"), "--target-frame", "nope"});
  EXPECT_EQ(nowhere.status, 1);
  EXPECT_LE(nowhere.error_lines(), 14U) << nowhere.err;
}

TEST_F(Mistakes, TheSettingThatIsWrongIsNamed) {
  const std::string cloud = ascii("in.pcd", {"1 2 3", "4 5 6"});
  EXPECT_THAT(run({cloud}, {.isa = "foo"}).err, HasSubstr("PCL_BV_ISA in the environment: unknown"));
  EXPECT_THAT(run({"--isa", "foo", cloud}).err, Not(HasSubstr("PCL_BV_ISA")));
  const std::string region =
      file("r.json", R"({"volumes":[{"shape":"sphere","center":[0,0,0],"radius":1}]})");
  for (const char* padding : {"nan", "inf", "-1"})
    EXPECT_THAT(run({"--drop-inside", region, "--padding", padding, cloud}).err,
                HasSubstr(std::string("--padding: '") + padding + "' is not a length from 0 to 1e100"));
  const Result tracks = run({"--cluster", "1", "--refine", "tracks", cloud});
  EXPECT_EQ(tracks.status, 2);
  EXPECT_THAT(tracks.err, HasSubstr("--refine: 'tracks' needs the tracks of a stream"));
  EXPECT_THAT(run({"--cluster", "1", "--cluster", "2", cloud}).err, HasSubstr("--cluster: given more than"));
  fs::create_directory(at("empty"));
  EXPECT_THAT(run({"--merge", at("empty")}).err, HasSubstr("no file of partial results in this folder"));
  EXPECT_THAT(run({"--config", at("gone.yaml"), cloud}).err, HasSubstr("gone.yaml: no such file or"));
  EXPECT_THAT(frames_to({"vtp:" + cloud}).err, HasSubstr("cannot create this folder: not a directory"));
}

TEST_F(Mistakes, ATextMayBeginWithAByteOrderMark) {
  const std::string region =
      file("bom.json", "\xEF\xBB\xBF{\"volumes\":[{\"shape\":\"sphere\",\"center\":[0,0,0],\"radius\":9}]}");
  const std::string cloud = ascii("in.pcd", {"1 2 3", "40 5 6"});
  const Result result = run({"--drop-inside", region, "--format", "json", cloud});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()[0]["counts"]["inside"], 1);
}

TEST_F(Mistakes, ALimitOfTheFileSizeIsAnErrorAndLeavesNoFile) {
  rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small = {100'000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::signal(SIGXFSZ, SIG_DFL);
  const Result result = run({"--cluster", "1", "--labels", at("labels.pcd"), "synth:street"});
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr("file too large"));
  for (const fs::directory_entry& entry : fs::directory_iterator(at("")))
    EXPECT_THAT(entry.path().filename().string(), testing::StartsWith("captured"));
}

TEST_F(Mistakes, TheFolderOfTemporaryFilesIsNamed) {
  const std::string cloud = ascii("in.pcd", {"1 2 3", "4 5 6"});
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  const std::string gone = at("gone");
  setenv("TMPDIR", gone.c_str(), 1);
  const Result result = run({"--together", "--cluster", "0.5", cloud});
  before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", kept.c_str(), 1);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("cannot use TMPDIR, " + gone));
}

TEST_F(Mistakes, ACloudOfSynthHasTheSuffixOfItsFormat) {
  for (const auto& [scene, output] : {std::pair{"street", "a.ply"}, {"box", "a"}, {"rig:2", "r.txt"}}) {
    const Result result = run({scene, at(output)}, {.program = "synth"});
    EXPECT_EQ(result.status, 2) << output;
    EXPECT_FALSE(fs::exists(at(output)));
  }
  EXPECT_EQ(run({"box", "/dev/null"}, {.program = "synth"}).status, 0);
  EXPECT_EQ(run({"box", "/dev/stdout"}, {.program = "synth", .output = at("b.pcd")}).status, 0);
  EXPECT_EQ(run({at("b.pcd")}).status, 0);
}

TEST_F(Mistakes, ACoordinateBeyondTheFloatsOfGltfIsNamed) {
  const std::string cloud = file("far.xyz", "1e99 1 1\n2e99 2 2\n3e99 3 4\n");
  const Result result = run({"--volume", "aabb", "--mesh", at("m.glb"), cloud});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("a coordinate is too large for the 32-bit floats of glTF"));
}

}  // namespace
}  // namespace pcl_bv::test
