// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// --concave: prisms whose outline follows bays.
#include <gmock/gmock.h>

#include <algorithm>

#include "command.h"

namespace pcl_bv::test {
namespace {

// Points 0.5 m apart on two legs of 10 m and 1 m width.
std::vector<std::string> corner() {
  std::vector<std::string> lines;
  for (int i = 0; i <= 20; ++i) {
    for (int k = 0; k <= 2; ++k) {
      lines.push_back(std::to_string(0.5 * i) + " " + std::to_string(0.5 * k) + " 1");
      lines.push_back(std::to_string(0.5 * k) + " " + std::to_string(0.5 * i) + " 2");
    }
  }
  return lines;
}

TEST_F(PcdBv, AConcaveOutlineIsCheckedPrintedAndReadBack) {
  const std::string cloud = ascii("corner.pcd", corner());
  const Result convex = run({"--volume", "prism", "--format", "json", cloud});
  const Result result =
      run({"--volume", "prism", "--concave", "0.6", "--check", "--format", "json", "--output", at("out.json"),
           "--mesh", at("out.ply"), "--image", at("out.svg"), cloud});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json outline = Json::parse(read_file(at("out.json")))[0]["clusters"][0]["volumes"][0]["outline"];
  double doubled = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Json &a = outline[i], &b = outline[(i + 1) % outline.size()];
    doubled += a[0].get<double>() * b[1].get<double>() - a[1].get<double>() * b[0].get<double>();
  }
  EXPECT_EQ(doubled / 2, 19) << "10 + 9 squares of 1 m";
  // Read back as a region, it has all points of the cloud, and a point in the bay is not in it.
  const std::string other = ascii("other.pcd", {"3 3 1.5", "0.25 0.25 1.5", "9.75 0.75 1.5"});
  const Result left = run({"--drop-inside", at("out.json"), "--volume", "aabb", "--format", "json", other});
  EXPECT_EQ(Json::parse(left.out)[0]["clusters"][0]["points"], 1) << left.out << left.err;
  EXPECT_EQ(Json::parse(left.out)[0]["clusters"][0]["volumes"][0]["min"], Json::parse("[3, 3, 1.5]"));
  EXPECT_EQ(Json::parse(convex.out)[0]["clusters"][0]["volumes"][0]["outline"].size(), 5U);
}

TEST_F(PcdBv, AConcaveLengthMustBeAboveZeroAndNeedsAllPoints) {
  const std::string cloud = ascii("corner.pcd", corner());
  const Result zero = run({"--volume", "prism", "--concave", "0", cloud});
  EXPECT_EQ(zero.status, 2);
  EXPECT_THAT(zero.err, testing::HasSubstr("--concave: 0 is not above 0"));
  const Result partial = run({"--volume", "prism", "--concave", "1", "--partial", at("a.part"), cloud});
  EXPECT_EQ(partial.status, 2);
  EXPECT_THAT(partial.err, testing::HasSubstr("prism with --concave needs all points"));
  const Result together = run({"--volume", "prism", "--concave", "1", "--together", "--check", cloud, cloud});
  EXPECT_EQ(together.status, 0) << together.err;
  EXPECT_THAT(run({"--volume", "aabb", "--concave", "1", cloud}).err,
              testing::HasSubstr("--concave: has no effect without prism"));
}

}  // namespace
}  // namespace pcl_bv::test
