// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Many inputs over the cores: the same bytes in the same order as one after another.

#include <gmock/gmock.h>

#include <filesystem>
#include <sstream>

#include "command.h"

namespace pcl_bv::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::MatchesRegex;

/// Inputs of very different size, the largest first, with broken ones between.
class PcdBvMany : public PcdBv {
 protected:
  PcdBvMany() {
    inputs_ = {"synth:street:8000:1"};
    for (int i = 0; i < 40; ++i) {
      const std::string n = std::to_string(i);
      inputs_.push_back(ascii("cloud" + n + ".pcd", {"0 0 " + n, "1 2 3"}));
      if (i % 7 == 3) inputs_.push_back(at("missing" + n + ".pcd"));
    }
  }

  Result with(std::vector<std::string> arguments, const Surroundings& surroundings = {}) const {
    arguments.insert(arguments.end(), inputs_.begin(), inputs_.end());
    return run(arguments, surroundings);
  }

  std::vector<std::string> inputs_;
};

TEST_F(PcdBvMany, ResultsAndProblemsAreTheSameForEveryNumberOfThreads) {
  for (const std::string format : {"text", "json", "jsonl", "csv"}) {
    SCOPED_TRACE(format);
    const Result one = with({"--threads", "1", "--format", format});
    EXPECT_EQ(one.status, 1);
    for (const std::string threads : {"0", "2", "3", "16"}) {
      const Result many = with({"--threads", threads, "--format", format});
      EXPECT_EQ(many.status, 1);
      EXPECT_EQ(many.out, one.out) << threads;
      EXPECT_EQ(many.problems(), one.problems()) << threads;
    }
  }
}

TEST_F(PcdBvMany, ResultsComeInTheOrderOfTheInputs) {
  const Result result = with({"--threads", "4", "--format", "json", "--volume", "obb-min"});
  const Json reports = result.json();
  ASSERT_EQ(reports.size(), inputs_.size());
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    EXPECT_EQ(reports[i]["file"], inputs_[i]);
  EXPECT_EQ(result.error_lines(), 7U);  // 6 missing ones and the summary
}

TEST_F(PcdBvMany, ASummaryComesLast) {
  const Result result = with({"--threads", "2"});
  const std::string last = result.err.substr(result.problems().size());
  EXPECT_THAT(last,
              MatchesRegex("pcd_bv: 47 files: 41 done, 6 failed, 8080 points, [0-9]+\\.[0-9][0-9] s\n"));
  EXPECT_EQ(run({inputs_[1]}).err, "");
}

TEST_F(PcdBvMany, EveryFileIsTheSameForEveryNumberOfThreads) {
  for (const std::string threads : {"1", "4"}) {
    const std::string folder = at("made" + threads);
    with({"--threads", threads, "--labels", folder, "--mesh", folder});
    run({"--threads", threads, "--image", folder, inputs_[1], inputs_[2], inputs_[3], inputs_[4]});
    for (int i = 0; i < 40; ++i) {
      for (const char* extension : {".pcd", ".ply", ".png"}) {
        const std::string name = "/cloud" + std::to_string(i) + extension;
        EXPECT_EQ(fs::exists(folder + name), i < 4 || std::string(extension) != ".png") << name;
        EXPECT_EQ(read_file(folder + name), read_file(at("made1") + name)) << name;
      }
    }
  }
}

TEST_F(PcdBvMany, AReaderThatGoesAwayEndsTheWorkBeforeTheBrokenInputs) {
  for (const std::string threads : {"1", "2"}) {
    const Result result =
        with({"--threads", threads, "--format", "jsonl", "--volume", "aabb"}, {.nobody_reads = true});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
  }
}

TEST_F(PcdBvMany, CheckingAndFilesGoOnThoughTheReportCannotBeWritten) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const Result result = with({"--threads", "2", "--labels", at("labels")}, {.output = "/dev/full"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.problems(), HasSubstr("pcd_bv: standard output: no space left on device\n"));
  EXPECT_EQ(result.error_lines(), 8U) << result.err;
  EXPECT_TRUE(fs::exists(at("labels/cloud39.pcd")));
}

TEST_F(PcdBvMany, TimingsAreOfEachFile) {
  std::istringstream lines(with({"--threads", "2", "--timings", "--format", "jsonl"}).out);
  std::size_t timed = 0;
  for (std::string line; std::getline(lines, line);) {
    const Json report = Json::parse(line);
    if (report.contains("error")) continue;
    ++timed;
    for (const char* stage : {"read", "segment", "fit"})
      EXPECT_GE(report["seconds"][stage], 0.0);
  }
  EXPECT_EQ(timed, 41U);
}

}  // namespace
}  // namespace pcl_bv::test
