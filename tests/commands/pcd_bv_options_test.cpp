// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command line itself: what is understood, and what is refused before any work.

#include <gmock/gmock.h>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_F(PcdBv, HelpNamesEveryOptionAndGivesExamples) {
  const Result result = run({"--help"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  for (const char* option :
       {"INPUT",    "--volume", "--range",   "--cluster", "--min-size", "--max-size",  "--ground",
        "--format", "--output", "--labels",  "--mesh",    "--image",    "--view",      "--threads",
        "--isa",    "--check",  "--timings", "--version", "Examples:",  "Exit status:"}) {
    EXPECT_THAT(result.out, HasSubstr(option));
  }
}

TEST_F(PcdBv, VersionListsTheInstructionSets) {
  const Result result = run({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, testing::ContainsRegex("pcd_bv [0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(result.out, HasSubstr("instruction sets: scalar"));
}

TEST_F(PcdBv, OptionsThatNoInputUsesAreRefused) {
  const std::string cloud = ascii("a.pcd", {"1 2 3"}), text = file("a.xyz", "1 2 3\n"),
                    bin = file("a.bin", std::string(12, '\0'));
  for (const auto& [arguments, what] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--topic", "/points", cloud}, "--topic: only useful with a recording"},
           {{"--topic", "/points", "synth:box"}, "--topic: only useful with a recording"},
           {{"--bin-fields", "3", cloud, text}, "--bin-fields: only useful with .bin files"},
           {{"--columns", "x,y,z", cloud, bin}, "--columns: only useful with text files"},
           {{"--together", "--bin-fields", "3", cloud}, "--bin-fields: only useful with .bin files"}}) {
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 2) << what;
    EXPECT_THAT(result.err, testing::StartsWith("pcd_bv: " + what));
    EXPECT_EQ(result.out, "");
  }
  EXPECT_EQ(run({"--bin-fields", "3", "--columns", "x,y,z", cloud, text, bin}).status, 0);
  EXPECT_EQ(run({"--bin-fields", "3", at("")}).status, 0);
  EXPECT_THAT(run({"--topic", "/points", at("gone")}).err, HasSubstr("no such file"));
}

TEST_F(PcdBv, WrongUseIsRefusedInOneLineBeforeAnyWork) {
  const std::string good = ascii("good.pcd", {"1 2 3"});
  const std::vector<std::vector<std::string>> cases = {
      {},
      {"--unknown", good},
      {"--volume", "cube", good},
      {"--volume", "aabb,,dop6", good},
      {"--volume", "", good},
      {"--volume", "aabb", "--volume", "dop6", good},
      {"--range", "5", good},
      {"--range", "-1:5", good},
      {"--range", "5:1", good},
      {"--range", "nan:1", good},
      {"--range", "1:2:3", good},
      {"--cluster", "-0.1", good},
      {"--cluster", "-0.5", good},
      {"--cluster", "inf", good},
      {"--cluster", "1e99", good},
      {"--cluster", "half", good},
      {"--min-size", "5", good},
      {"--min-points", "5", good},
      {"--cluster", "1", "--min-points", "0", good},
      {"--cluster", "1", "--min-points", "2.5", good},
      {"--cluster", "1", "--min-size", "-5", good},
      {"--cluster", "1", "--min-size", "2.5", good},
      {"--cluster", "1", "--max-size", "0", good},
      {"--cluster", "1", "--min-size", "9", "--max-size", "8", good},
      {"--min-extent", "1,1,1", good},
      {"--cluster", "1", "--min-extent", "1", good},
      {"--cluster", "1", "--min-extent", "1,1,inf", good},
      {"--cluster", "1", "--max-extent", "5,-1,5", good},
      {"--cluster", "1", "--min-extent", "1,1,2", "--max-extent", "5,5,1", good},
      {"--together", "--max-extent", "5,5,1", good},
      {"--format", "xml", good},
      {"--ground", "magic", good},
      {"--image", at("a.png"), "--view", "below", good},
      {"--view", "iso", good},
      {"--threads", "-1", good},
      {"--threads", "99999999999999999999", good},
      {"--threads", "many", good},
      {"--isa", "mmx", good},
      {"--growth", "fast", good},
      {"--concave", "-1", "--volume", "prism", good},
      {"--concave", "inf", "--volume", "prism", good},
      {"--up", "w", "--volume", "obb-yaw", good},
      {"--up", "y", "--volume", "obb-min", good},
      {"--output", "", good},
      {"--mesh", "", good},
      {"--mesh", "a.obj", good},
      {"--image", "a.jpg", good},
      {"--volume"},
      {"--preset", "sea", good},
      {"--config", at("none.yaml"), good},
      {"--ground-slope", "5", good},
      {"--ground", "plane", "--ground-slope", "90", good},
  };
  for (const auto& arguments : cases) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.error_lines(), 1u) << result.err;
    EXPECT_THAT(result.err, testing::StartsWith("pcd_bv: "));
  }
}

TEST_F(PcdBv, AnEmptyValueIsRefusedAndTakesNoInput) {
  const std::string good = ascii("good.pcd", {"1 2 3"}), content = read_file(good);
  for (const std::string option : {"--output", "--labels", "--mesh", "--image"}) {
    const std::string error = "pcd_bv: " + option + ": the name is empty\n";
    EXPECT_EQ(run({option + "=", good}).err, error);
    EXPECT_EQ(run({option, "", good}).err, error);
    EXPECT_EQ(run({good, option + "="}).err, error);
    EXPECT_EQ(run({option + "=", good}).status, 2);
  }
  EXPECT_EQ(read_file(good), content);
  for (const std::string option :
       {"--volume", "--range", "--cluster", "--ground", "--format", "--threads", "--isa"})
    EXPECT_EQ(run({option + "=", good, good}).err, "pcd_bv: " + option + ": the value is empty\n");
  for (const std::string option : {"--stats", "--sink", "--source", "--config"}) {
    const Result result = run({option + "="}, {.program = "bv_stream"});
    EXPECT_EQ(result.err, "bv_stream: " + option + ": the name is empty\n");
    EXPECT_EQ(result.status, 2);
  }
  EXPECT_EQ(run({"--", "--output="}).err, "pcd_bv: --output=: no such file or directory\n");
}

TEST_F(PcdBv, OptionsThatNameTheDefaultAreAccepted) {
  const std::string good = ascii("good.pcd", {"1 2 3", "4 5 7"});
  const Result plain = run({good});
  const Result spelled = run({"--ground", "none", "--format", "text", "--threads", "0", good});
  EXPECT_EQ(spelled.status, 0);
  EXPECT_EQ(spelled.out, plain.out);
  EXPECT_EQ(run({"--isa=auto", "--", good}).out, plain.out);
}

TEST_F(PcdBv, UnknownInstructionSetInTheEnvironmentIsRefused) {
  const std::string good = ascii("good.pcd", {"1 2 3"});
  const Result result = run({good}, {.isa = "foo"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("foo"));
  EXPECT_EQ(run({"--isa", "scalar", good}, {.isa = "foo"}).status, 0);
  EXPECT_EQ(run({good}, {.isa = "scalar"}).status, 0);
#if defined(__x86_64__)
  EXPECT_EQ(run({good}, {.isa = "neon"}).status, 2);
  EXPECT_EQ(run({"--isa", "sve2", good}).status, 2);
#endif
}

TEST_F(PcdBv, MethodsComeOnceEachInTheOrderAsked) {
  const std::string good = ascii("good.pcd", {"1 2 3", "4 5 7"});
  const Json report = run({"--format", "jsonl", "--volume", "dop26,aabb,dop26,dop6", good}).json();
  std::vector<std::string> names;
  for (const Json& volume : report["clusters"][0]["volumes"])
    names.push_back(volume["method"]);
  EXPECT_THAT(names, testing::ElementsAre("dop26", "aabb", "dop6"));
}

TEST_F(PcdBv, AllIsEveryMethodButNeverTheHull) {
  const std::string good = ascii("good.pcd", {"1 2 3", "4 5 7"});
  const Json report = run({"--format", "jsonl", "--volume", "all", good}).json();
  std::vector<std::string> names;
  for (const Json& volume : report["clusters"][0]["volumes"])
    names.push_back(volume["method"]);
  EXPECT_THAT(names, testing::IsSupersetOf({"aabb", "dop6", "dop14", "dop18", "dop26", "sphere-epos26",
                                            "obb-pca", "obb-dito14", "obb-min", "obb-yaw", "obb-lshape"}));
  EXPECT_THAT(names, Not(testing::Contains("hull")));
}

TEST_F(PcdBv, BestIsOneVolumeThatSaysItsShape) {
  const std::string pole =
      ascii("pole.pcd", {"0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 0 9", "1 0 9", "0 1 9", "1 1 9"});
  const Json report = run({"--format", "jsonl", "--volume", "best,hull,ellipsoid", "--check", pole}).json();
  const Json& volumes = report["clusters"][0]["volumes"];
  ASSERT_EQ(volumes.size(), 3u);
  EXPECT_EQ(volumes[0]["method"], "best");
  EXPECT_EQ(volumes[0]["shape"], "aabb");
  EXPECT_EQ(volumes[1]["faces"].size(), 12u);
  EXPECT_EQ(volumes[1]["planes"].size(), 6u);
  for (const Json& volume : volumes)
    EXPECT_EQ(volume["outside"], 0);
}

TEST_F(PcdBv, DefaultIsABoxASphereAndAnOrientedBox) {
  const std::string good = ascii("good.pcd", {"1 2 3", "4 5 7"});
  const Json volumes = run({"--format", "jsonl", good}).json()["clusters"][0]["volumes"];
  ASSERT_EQ(volumes.size(), 3u);
  EXPECT_EQ(volumes[0]["shape"], "aabb");
  EXPECT_EQ(volumes[1]["shape"], "sphere");
  EXPECT_EQ(volumes[2]["method"], "obb-min");
}

}  // namespace
}  // namespace pcl_bv::test
