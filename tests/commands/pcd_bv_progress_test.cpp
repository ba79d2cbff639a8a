// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The bar of --progress, at a terminal and elsewhere.

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

/// The lines that a terminal shows in the end. A carriage return goes back to the line's first column.
std::vector<std::string> on_screen(const std::string& written, std::size_t* widest = nullptr) {
  std::vector<std::string> lines{""};
  std::size_t column = 0;
  for (const char c : written) {
    if (c == '\n') {
      lines.emplace_back();
    } else if (c == '\r') {
      column = 0;
    } else {
      std::string& line = lines.back();
      line.resize(std::max(line.size(), column + 1), ' ');
      line[column++] = c;
      if (widest != nullptr) *widest = std::max(*widest, column);
    }
  }
  for (std::string& line : lines)
    line.erase(line.find_last_not_of(' ') + 1);
  return lines;
}

TEST_F(PcdBv, ProgressIsABarOfFilesPointsAndSecondsThatGoesAway) {
  if (!has_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  std::vector<std::string> arguments = {"--progress", "--threads", "2"};
  for (int i = 0; i < 10; ++i)
    arguments.push_back("synth:gauss:250000:" + std::to_string(i + 1));
  const Result result = run(arguments, {.terminal = true});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("[------------------------------] 0/10 files, 0.0 M points, 0.0 s"));
  EXPECT_THAT(result.err, HasSubstr("[###############---------------] 5/10 files, 1.2 M points, "));
  EXPECT_THAT(result.err, HasSubstr("[##############################] 10/10 files, 2.5 M points, "));
  std::size_t widest = 0;
  const std::vector<std::string> screen = on_screen(result.err, &widest);
  ASSERT_EQ(screen.size(), 2U) << result.err;
  EXPECT_THAT(screen[0], HasSubstr("pcd_bv: 10 files: 10 done, 0 failed, 2500000 points"));
  EXPECT_EQ(screen[1], "");
  EXPECT_LT(widest, 80U);
}

TEST_F(PcdBv, ProgressNeverMixesWithProblems) {
  if (!has_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  std::vector<std::string> arguments = {"--progress"};
  for (int i = 0; i < 5; ++i) {
    arguments.push_back("synth:sphere:1000");
    arguments.push_back(at("missing" + std::to_string(i)));
  }
  const Result result = run(arguments, {.terminal = true});
  const std::vector<std::string> screen = on_screen(result.err);
  ASSERT_EQ(screen.size(), 7U) << result.err;
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(screen[i], "pcd_bv: " + at("missing" + std::to_string(i)) + ": no such file or directory");
}

TEST_F(PcdBv, ProgressIsNothingWithoutATerminalAndWithoutBeingAsked) {
  if (!has_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  const std::string cloud = ascii("c.pcd", {"1 2 3"});
  const Result plain = run({cloud});
  EXPECT_EQ(run({"--progress", cloud}).err, "");
  EXPECT_EQ(run({"--progress", cloud}).out, plain.out);
  EXPECT_EQ(run({cloud}, {.terminal = true}).err, "");
  const Result bar = run({"--progress", cloud}, {.terminal = true});
  EXPECT_EQ(bar.out, plain.out);
  EXPECT_THAT(bar.err, HasSubstr("1/1 files"));
  EXPECT_EQ(on_screen(bar.err), std::vector<std::string>{""});
}

}  // namespace
}  // namespace pcl_bv::test
