// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// --concave: prisms whose outline follows bays.
#include <gmock/gmock.h>

#include <algorithm>

#include "command.h"
#include "pcl_bv/report/read_volumes.h"

namespace pcl_bv::test {
namespace {

using namespace detail;

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
  const Result result = run({"--volume", "prism", "--concave", "1", "--check", "--format", "json", "--output",
                             at("out.json"), "--mesh", at("out.ply"), "--image", at("out.svg"), cloud});
  ASSERT_EQ(result.status, 0) << result.err;
  const AnyVolume volume = read_volumes(at("out.json")).front();
  const auto& prism = std::get<Prism>(volume);
  EXPECT_FALSE(prism.is_convex());
  EXPECT_EQ(prism.footprint_area(), 19) << "10 + 9 squares of 1 m";
  EXPECT_FALSE(prism.contains({3, 3, 1.5}));
  EXPECT_EQ(Json::parse(convex.out)["clusters"][0]["volumes"][0]["outline"].size(), 5U);
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
