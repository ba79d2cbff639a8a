// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How pcd_bv ends: which reason wins, and what happens when nobody reads.

#include <gmock/gmock.h>

#include "command.h"
#include "status.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

using testing::StartsWith;

TEST(PcdBvStatus, MisuseWinsThenOutsideThenFailed) {
  const Status order[] = {Status::misuse, Status::outside, Status::failed, Status::done};
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) {
      EXPECT_EQ(worse(order[i], order[j]), order[i]);
      EXPECT_EQ(worse(order[j], order[i]), order[i]);
    }
  }
  EXPECT_EQ(static_cast<int>(Status::misuse), 2);
  EXPECT_EQ(static_cast<int>(Status::outside), 3);
  EXPECT_EQ(static_cast<int>(Status::failed), 1);
  EXPECT_EQ(static_cast<int>(Status::done), 0);
}

TEST_F(PcdBv, WrongUseWinsOverABadInput) {
  const Result result = run({"--volume", "cube", at("missing.pcd")});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.error_lines(), 1u) << result.err;
}

TEST_F(PcdBv, BadInputWinsOverGoodOnesWhereverItStands) {
  const std::string good = ascii("good.pcd", {"1 2 3"});
  EXPECT_EQ(run({at("missing.pcd"), good}).status, 1);
  EXPECT_EQ(run({good, at("missing.pcd")}).status, 1);
  EXPECT_EQ(run({"--check", good, at("missing.pcd"), good}).status, 1);
}

TEST_F(PcdBv, ClosedPipeEndsQuietlyWithZero) {
  const std::string good = ascii("good.pcd", {"1 2 3"});
  for (const std::string format : {"text", "json", "jsonl", "csv"}) {
    SCOPED_TRACE(format);
    const Result result = run({"--format", format, good, good}, {.nobody_reads = true});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
  }
  EXPECT_EQ(run({"--help"}, {.nobody_reads = true}).status, 0);
  EXPECT_EQ(run({"--version"}, {.nobody_reads = true}).status, 0);
}

TEST_F(PcdBv, FullDiskUnderStandardOutputIsStatusOne) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string good = ascii("good.pcd", {"1 2 3"});
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{good}, {"--format", "json", good}, {"--help"}, {"--version"}}) {
    const Result result = run(arguments, {.output = "/dev/full"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, StartsWith("pcd_bv: standard output: "));
    EXPECT_EQ(result.error_lines(), 1u) << result.err;
  }
}

}  // namespace
}  // namespace pcl_bv::test
