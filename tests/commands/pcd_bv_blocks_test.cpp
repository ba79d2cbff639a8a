// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds that are read in blocks: the answers of clouds that are held, in little memory.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "command.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

const std::string kVolumes =
    "aabb,dop14,dop26,sphere,sphere-ritter,obb-pca,obb-dito14,obb-min,obb-yaw,obb-lshape,prism,capsule,hull";

// With bad points and dead beams.
std::vector<float> random_points(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<float> xyz(3 * n);
  for (std::size_t i = 0; i < xyz.size(); ++i)
    xyz[i] = normal(random) * (i % 3 == 0 ? 5.0f : 1.0f);
  for (std::size_t i = 0; i < n; i += 1000)
    xyz[3 * i + i % 3] = std::nanf("");
  for (std::size_t i = 7; i < n; i += 500)
    std::fill_n(&xyz[3 * i], 3, 0.0f);
  return xyz;
}

// The report without the file's name.
Json answer(const Result& result) {
  Json report = result.json();
  report.erase("file");
  return report;
}

class PcdBvBlocks : public PcdBv {
 protected:
  std::string write(const char* name, const RawCloud& cloud,
                    PcdEncoding encoding = PcdEncoding::binary) const {
    write_pcd(at(name), cloud, encoding);
    return at(name);
  }

  Json fit(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--volume", kVolumes, "--format", "jsonl"});
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return answer(result);
  }
};

TEST_F(PcdBvBlocks, GiveTheVolumesOfCloudsInMemory) {
  const RawCloud cloud = make_cloud(random_points(70'000, 1));
  const std::string held = write("held.pcd", cloud, PcdEncoding::binary_compressed),
                    blocks = write("blocks.pcd", cloud);
  EXPECT_EQ(fit({blocks}), fit({held}));
  EXPECT_EQ(fit({"--check", blocks}), fit({"--check", held}));
  EXPECT_EQ(fit({"--info", blocks}), fit({"--info", held}));
}

TEST_F(PcdBvBlocks, AreFilteredByRangeAsTheyComePast) {
  const RawCloud cloud = make_cloud(random_points(70'000, 2));
  const std::string held = write("held.pcd", cloud, PcdEncoding::binary_compressed),
                    blocks = write("blocks.pcd", cloud);
  const Json report = fit({"--range", "0.5:6", "--check", blocks});
  EXPECT_EQ(report, fit({"--range", "0.5:6", "--check", held}));
  EXPECT_EQ(report["counts"]["nonfinite"], 70);
  EXPECT_GT(report["counts"]["range"], 1000);
  for (const Json& volume : report["clusters"][0]["volumes"])
    EXPECT_EQ(volume["outside"], 0) << volume["method"];
  const auto box = report["clusters"][0]["volumes"][0];
  EXPECT_LE(box["max"][0], 6);
  EXPECT_GT(box["max"][0], 5.5);
}

TEST_F(PcdBvBlocks, FilesBesideTheReportChangeNoVolume) {
  const std::string blocks = write("blocks.pcd", make_cloud(random_points(70'000, 3)));
  const Json expected = fit({"--range", "0:6", blocks});
  EXPECT_EQ(fit({"--range", "0:6", "--labels", at("labels.pcd"), blocks}), expected);
  EXPECT_EQ(fit({"--range", "0:6", "--image", at("image.png"), blocks}), expected);
  EXPECT_EQ(fit({"--range", "0:6", "--mesh", at("mesh.ply"), blocks}), expected);
  const RawCloud labels = read_pcd(at("labels.pcd"));
  const PointField* field = find_field(labels, "label");
  ASSERT_NE(field, nullptr);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    std::uint32_t label = 1;
    std::memcpy(&label, &labels.data[i * labels.point_step + field->offset], sizeof label);
    inside += label == 0;
  }
  EXPECT_EQ(inside, expected["clusters"][0]["points"]);
}

TEST_F(PcdBvBlocks, OfABigCloudAreDrawn) {
  const std::string blocks = write("blocks.pcd", make_cloud(random_points(70'000, 4)));
  const std::string held = write("held.pcd", read_pcd(blocks), PcdEncoding::binary_compressed);
  EXPECT_EQ(run({"--image", at("blocks.png"), blocks}).status, 0);
  EXPECT_EQ(run({"--image", at("held.png"), held}).status, 0);
  EXPECT_GT(std::filesystem::file_size(at("blocks.png")), 10'000U);
  EXPECT_TRUE(read_file(at("blocks.png")) == read_file(at("held.png")));
}

// Sanitizers need memory of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(PcdBvBlocks, LeaveTheCloudInItsFile) {
  const RawCloud cloud = make_cloud(random_points(8'000'000, 5));
  const std::string blocks = write("blocks.pcd", cloud),
                    held = write("held.pcd", cloud, PcdEncoding::binary_compressed);
  ASSERT_GT(std::filesystem::file_size(blocks), 90'000'000U);
  const auto in_64_megabytes = [&](const std::string& input) {
    return run({"-c", "ulimit -d 64000; exec \"$0\" \"$@\"", PCL_BV_BIN_DIR "/pcd_bv", "--volume",
                "aabb,dop26,sphere,obb-pca", "--range", "0:20", "--check", "--info", "--threads", "2", input},
               {.program = "/bin/sh"});
  };
  EXPECT_EQ(in_64_megabytes(blocks).status, 0);
  EXPECT_THAT(in_64_megabytes(held).err, testing::HasSubstr("not enough memory"));  // the limit is one
}
#endif

TEST_F(PcdBvBlocks, SpacingIsTheMedianOfExactDistances) {
  const std::vector<float> xyz = random_points(70'000, 6);
  std::vector<std::array<double, 3>> used;
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const std::array<double, 3> p{xyz[i], xyz[i + 1], xyz[i + 2]};
    if (std::isnan(p[0] + p[1] + p[2]) || p == std::array<double, 3>{0, 0, 0}) continue;
    used.push_back(p);
  }
  std::vector<double> nearest;
  for (std::size_t k = 0; k < 1000; ++k) {
    const std::size_t sample = k * used.size() / 1000;
    double best = INFINITY;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const double d = std::hypot(used[i][0] - used[sample][0], used[i][1] - used[sample][1],
                                  used[i][2] - used[sample][2]);
      if (i != sample) best = std::min(best, d);
    }
    nearest.push_back(best);
  }
  std::nth_element(nearest.begin(), nearest.begin() + 500, nearest.end());
  const std::string blocks = write("blocks.pcd", make_cloud(xyz));
  const Json info = run({"--info", "--format", "jsonl", blocks}).json()["info"];
  EXPECT_EQ(info["spacing"], nearest[500]);
  EXPECT_EQ(info["nonfinite"], 70);
  EXPECT_EQ(info["zero"], 140);
}

TEST_F(PcdBvBlocks, OfATruncatedFileAreRefused) {
  const std::string blocks = write("blocks.pcd", make_cloud(random_points(70'000, 7)));
  std::filesystem::resize_file(blocks, std::filesystem::file_size(blocks) - 1);
  const Result result = run({blocks});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, testing::HasSubstr("truncated: 70000 points of 12 bytes need 840000 bytes"));
}

}  // namespace
}  // namespace pcl_bv::test
