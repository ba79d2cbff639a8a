// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A file of two gigabytes, whose box is known, in 64 megabytes of memory.

#include <gmock/gmock.h>

#include <array>
#include <bit>
#include <filesystem>
#include <fstream>
#include <vector>

#include "command.h"

namespace pcl_bv::test {
namespace {

// 16 bytes each, and more points than 2^27.
constexpr std::size_t kPoints = 140'000'000;
constexpr std::size_t kAtATime = 1'000'000;

class TwoGigabytes : public PcdBv {
 protected:
  // x y z intensity inside the unit cube, but for one point far behind.
  std::string write() const {
    const std::string path = at("big.pcd");
    std::ofstream file(path, std::ios::binary);
    const std::string n = std::to_string(kPoints);
    file << "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH " << n
         << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << n << "\nDATA binary\n";
    std::vector<std::array<float, 4>> part(kAtATime);
    std::uint32_t state = 1;
    for (std::size_t first = 0; first < kPoints; first += kAtATime) {
      for (auto& point : part) {
        for (float& value : point) {
          state = state * 1664525u + 1013904223u;
          value = static_cast<float>(state >> 8) * 0x1p-24f;
        }
      }
      if (first == 0) part[5] = {0, 0, 0, 0};
      if (first + kAtATime == kPoints) part.back() = {3, 1, 2, 0};
      file.write(reinterpret_cast<const char*>(part.data()),
                 static_cast<std::streamsize>(part.size() * sizeof part[0]));
    }
    return path;
  }

  Result in_64_megabytes(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(),
                     {"-c", "ulimit -d 64000; exec \"$0\" \"$@\"", PCL_BV_BIN_DIR "/pcd_bv"});
    return run(arguments, {.program = "/bin/sh"});
  }
};

TEST_F(TwoGigabytes, AreFittedAndCheckedInSixtyFourMegabytes) {
  const std::string path = write();
  ASSERT_GT(std::filesystem::file_size(path), std::size_t{2} << 30);
  const Result result = in_64_megabytes({"--volume", "aabb,dop26,sphere,obb-dito14,obb-yaw", "--threads", "2",
                                         "--check", "--info", "--format", "jsonl", path});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json report = result.json();
  EXPECT_EQ(report["points"], kPoints);
  const Json& volumes = report["clusters"][0]["volumes"];
  EXPECT_EQ(volumes[0]["min"], Json::parse("[0,0,0]"));
  EXPECT_EQ(volumes[0]["max"], Json::parse("[3,1,2]"));
  for (const Json& volume : volumes)
    EXPECT_EQ(volume["outside"], 0) << volume["method"];
  EXPECT_EQ(report["info"]["zero"], 1);

  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  const Result cut = in_64_megabytes({path});
  EXPECT_EQ(cut.status, 1);
  EXPECT_THAT(cut.err, testing::HasSubstr("truncated: 140000000 points of 16 bytes need 2240000000 bytes"));
}

}  // namespace
}  // namespace pcl_bv::test
