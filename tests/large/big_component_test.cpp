// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// An object of more than 10^8 points that lies in hundreds of files, in little memory.

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "command.h"

namespace pcl_bv::test {
namespace {

class BigComponent : public PcdBv {
 protected:
  static constexpr long kMegabytes = 300;
  // What the program takes beside --memory: buffers of 64 MB, the index of the shares, and 80 000 objects.
  static constexpr long kBeside = 200;

  Result measured(const std::vector<std::string>& options) const {
    std::vector<std::string> all{
        "-f",  "%M",       "-o",      at("kib"),  PCL_BV_BIN_DIR "/pcd_bv",  "--cluster",
        "0.5", "--volume", "obb-pca", "--memory", std::to_string(kMegabytes)};
    all.insert(all.end(), options.begin(), options.end());
    Result result = run(all, {.program = "/usr/bin/time"});
    EXPECT_EQ(result.status, 0) << result.err;
    const long kib = std::stol(read_file(at("kib")));
    EXPECT_LE(kib / 1000, kMegabytes + kBeside) << options.front();
    RecordProperty(options.front() + " MB", static_cast<int>(kib / 1000));
    return result;
  }
};

// The ground of a town of 600 tiles.
TEST_F(BigComponent, OfAllTilesIsTheSameObjectForSharesAndTakesLittleMemory) {
  ASSERT_EQ(run({"town:600:1", at("town")}, {.program = "synth"}).status, 0);
  const Result whole = measured({"--together", "--format", "jsonl", at("town")});
  EXPECT_GT(whole.json()["clusters"][0]["points"], 100'000'000);
  for (const std::string part : {"0/3", "1/3", "2/3"})
    measured({"--partial", at("parts/" + part.substr(0, 1)), "--part", part, at("town")});
  const Result merged = measured({"--merge", "--format", "jsonl", at("parts")});
  EXPECT_TRUE(merged.out == whole.out);
}

}  // namespace
}  // namespace pcl_bv::test
