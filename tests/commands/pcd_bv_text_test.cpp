// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table for people.

#include <gmock/gmock.h>

#include <sstream>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

TEST_F(PcdBv, TextShowsFilePointsCountsAndEveryVolume) {
  const std::string cloud = ascii("c.pcd", {"0 0 0", "2 4 8", "nan 1 1"});
  const Result result = run({"--volume", "aabb,dop6", "--check", cloud});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr(cloud + ": 3 points, 1 not finite"));
  EXPECT_THAT(result.out, HasSubstr("method"));
  EXPECT_THAT(result.out,
              testing::ContainsRegex(
                  "0 +2 +aabb +1\\.0000 2\\.0000 4\\.0000 +2\\.0000 4\\.0000 8\\.0000 +64\\.00 +0\n"));
  EXPECT_THAT(result.out, HasSubstr("dop6"));
}

TEST_F(PcdBv, TextFitsTheTerminal) {
  const std::string far = ascii("far.pcd", {"-5000000 4000000 100", "-4999000 4000500 400"});
  const std::string tiny = ascii("tiny.pcd", {"1e-41 -1e-41 0", "-1e-30 2e-39 1e-20"});
  const std::string huge = ascii("huge.pcd", {"-1.234567e38 1e20 1", "3e38 -3e38 -3e38"});
  for (const std::string& input : {far, tiny, huge, std::string("synth:street")}) {
    std::istringstream lines(run({"--volume", "all", "--check", input}).out);
    std::string line;
    std::getline(lines, line);  // the file's name may be long
    while (std::getline(lines, line)) {
      EXPECT_LE(line.size(), 120u) << line;
      EXPECT_THAT(line, testing::Not(testing::EndsWith(" ")));
    }
  }
}

TEST_F(PcdBv, TimingsAreShownOnlyWhenAsked) {
  const std::string cloud = ascii("c.pcd", {"0 0 0"});
  EXPECT_THAT(run({"--timings", cloud}).out,
              testing::ContainsRegex("read [0-9.]+, segment [0-9.]+, fit [0-9.]+ ms"));
  EXPECT_THAT(run({cloud}).out, testing::Not(HasSubstr(" ms")));
}

}  // namespace
}  // namespace pcl_bv::test
