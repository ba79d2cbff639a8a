// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Valid points of every magnitude through every output of the command: a result, or one line and status 1.

#include <gmock/gmock.h>

#include <map>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::AnyOf;
using testing::ContainsRegex;
using testing::Not;

class Magnitudes : public PcdBv {
 protected:
  std::vector<std::string> clouds() const {
    const std::map<std::string, std::string> texts{
        {"equal.xyz", "1e20 1e20 1e20\n"},
        {"equal_far.xyz", "1e100 -1e100 1e100\n1e100 -1e100 1e100\n"},
        {"tiny.xyz", "1e-300 0 0\n0 2e-300 0\n0 0 1e-300\n3e-300 0 1e-300\n"},
        {"denormal.xyz", "5e-324 0 0\n0 5e-324 0\n0 0 5e-324\n5e-324 5e-324 1e-323\n"},
        {"huge.xyz", "1e100 0 0\n0 1e100 0\n0 0 -1e100\n-1e100 0 0\n1 2 3\n"},
        {"beyond_float.xyz", "4e38 0 0\n0 4e38 0\n0 0 4e38\n1 2 3\n"},
        {"mixed.xyz", "1e-300 1 1e99\n3e-300 2 5e99\n2e-300 7 1e98\n0 0 0\n"},
        {"far_and_small.xyz", "1e16 1e16 0\n1e16 1e16 1e-300\n1e16 1e16 1e-10\n"}};
    std::vector<std::string> files;
    for (const auto& [name, text] : texts)
      files.push_back(file(name, text));
    return files;
  }

  void expect_result_or_line(const std::vector<std::string>& arguments) const {
    const Result result = run(arguments);
    SCOPED_TRACE(arguments[1] + " " + arguments.back() + "\n" + result.err);
    EXPECT_THAT(result.status, AnyOf(0, 1));
    EXPECT_LE(result.error_lines(), 1U);
    EXPECT_TRUE(result.status == 0 || result.error_lines() == 1);
    EXPECT_THAT(result.out, Not(ContainsRegex("[ ,:[]-?(nan|inf|null)")));
  }
};

TEST_F(Magnitudes, GiveAResultOrALineInEveryFormat) {
  for (const std::string& cloud : clouds()) {
    for (const std::string view : {"iso", "top", "front", "side"})
      expect_result_or_line({"--view", view, "--image", at(view + ".png"), cloud});
    expect_result_or_line({"--image", at("i.svg"), "--volume", "sphere,obb-yaw,prism", cloud});
    expect_result_or_line({"--view-html", at("v.html"), cloud});
    for (const std::string name : {"m.ply", "m.vtp", "m.glb"})
      expect_result_or_line({"--mesh", at(name), "--volume", "all", cloud});
    expect_result_or_line({"--labels", at("l.pcd"), cloud});
    for (const std::string format : {"text", "json", "jsonl", "csv", "3dtiles", "3dtiles-region", "kitti",
                                     "nuscenes", "openlabel", "sustech"})
      expect_result_or_line({"--format", format, "--volume", "aabb,obb-yaw,sphere", cloud});
  }
}

TEST_F(Magnitudes, DrawEqualPointsFarFromTheOrigin) {
  const std::string cloud = file("p.xyz", "1e20 1e20 1e20\n");
  for (const std::string view : {"iso", "top", "front", "side"}) {
    ASSERT_EQ(run({"--view", view, "--image", at("q.png"), cloud}).status, 0);
    EXPECT_THAT(read_file(at("q.png")), testing::StartsWith("\x89PNG"));
  }
}

}  // namespace
}  // namespace pcl_bv::test
