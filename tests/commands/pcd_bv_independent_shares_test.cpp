// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Partial results of inputs that were processed independently: --partial, and --merge without --cluster.

#include <gmock/gmock.h>

#include "tiles.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

// Without obb-pca, whose sums depend on the tiles, and best, which can select it.
const std::string kSameBits =
    "aabb,dop6,dop14,dop18,dop26,sphere,obb-dito14,obb-min,obb-yaw,prism,cylinder,capsule,ellipsoid,hull";

class PcdBvIndependentShares : public Tiled {
 protected:
  void partial(const std::string& to, const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{"--partial", at(to)};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result result = run(all);
    EXPECT_EQ(result.status, 0) << result.err;
  }

  Result merge(const std::string& volumes, const std::vector<std::string>& files) const {
    std::vector<std::string> arguments{"--merge", "--format", "jsonl", "--volume", volumes};
    for (const std::string& name : files)
      arguments.push_back(at(name));
    return run(arguments);
  }

  void merge_to_file(const std::string& to, const std::vector<std::string>& files) const {
    std::vector<std::string> arguments{"--merge"};
    for (const std::string& name : files)
      arguments.push_back(at(name));
    partial(to, arguments);
  }

  // Writes the tiles t1.pcd, t2.pcd, ..., and their partial results p1, p2, ...: of t2 in three shares.
  // Returns the names of the partial results.
  std::vector<std::string> make_tiles(const Points& points, const std::vector<std::size_t>& cuts) const {
    std::vector<std::string> files;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const std::string number = std::to_string(i + 1);
      const std::string tile = binary("tiles/t" + number + ".pcd",
                                      Points(points.begin() + static_cast<std::ptrdiff_t>(cuts[i]),
                                             points.begin() + static_cast<std::ptrdiff_t>(cuts[i + 1])));
      for (const std::string part : {"0", "1", "2"}) {
        files.push_back("p" + number + "_" + part);
        const std::string share = i == 1 ? part + "/3" : "0/1";
        partial(files.back(), {"--part", share, tile});
        if (i != 1) break;
      }
    }
    return files;
  }

  // Merges any two files to one, until `count` are left.
  std::vector<std::string> grouped(std::vector<std::string> files, std::size_t count,
                                   std::mt19937& random) const {
    std::shuffle(files.begin(), files.end(), random);
    while (files.size() > count) {
      const std::size_t i = random() % (files.size() - 1);
      const std::string pair = "pair" + std::to_string(pairs_++);
      merge_to_file(pair, {files[i], files[i + 1]});
      files[i] = pair;
      files.erase(files.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
    return files;
  }

  Result together(const std::string& volumes) const {
    return run({"--together", "--format", "jsonl", "--volume", volumes, at("tiles")});
  }

 private:
  mutable std::size_t pairs_ = 0;
};

TEST_F(PcdBvIndependentShares, AreOneCloudInAnyOrderAndGroups) {
  const Points points = gaussian(120'000, 1);
  std::filesystem::create_directories(at("tiles"));
  // t1 has only whole blocks, t3 stores all points, t4 one point, t5 none, and t10 comes after t9.
  const std::vector<std::string> files =
      make_tiles(points, {0, 4096, 70'000, 72'001, 72'002, 72'002, 80'000, 90'123, 99'000, 110'001, 120'000});
  ASSERT_EQ(files.size(), 12U);
  const Result expected = together(kSameBits), best = merge("obb-pca,best", files);
  EXPECT_EQ(best.status, 0) << best.err;
  EXPECT_NEAR(best.json()["clusters"][0]["volumes"][0]["volume"].get<double>(),
              together("obb-pca").json()["clusters"][0]["volumes"][0]["volume"].get<double>(), 1e-9);
  for (unsigned seed = 1; seed <= 6; ++seed) {
    std::mt19937 random(seed);
    const std::vector<std::string> groups = grouped(files, seed < 4 ? 1 : seed, random);
    const Result merged = merge(kSameBits, groups);
    EXPECT_EQ(merged.status, 0) << merged.err;
    EXPECT_TRUE(merged.out == expected.out) << "seed " << seed;
    EXPECT_TRUE(merge("obb-pca,best", groups).out == best.out) << "seed " << seed;
  }
}

TEST_F(PcdBvIndependentShares, WithFewPointsHaveAllBitsOfOneCloud) {
  const Points points = gaussian(4096, 2);
  std::filesystem::create_directories(at("tiles"));
  const std::vector<std::string> files = make_tiles(points, {0, 7, 1500, 4096});
  EXPECT_TRUE(merge(kServed, files).out == together(kServed).out);
}

TEST_F(PcdBvIndependentShares, AreMergedAsDoublesIfOneHasDoubles) {
  const Points points = gaussian(30'000, 3);
  std::filesystem::create_directories(at("tiles"));
  std::vector<std::string> files = make_tiles(points, {0, 9000, 20'000});
  std::string content = header(10'000, "binary");
  content.replace(content.find("SIZE 4 4 4"), 10, "SIZE 8 8 8");
  for (std::size_t i = 20'000; i < points.size(); ++i)
    for (const double x : points[i])
      content.append(reinterpret_cast<const char*>(&x), sizeof x);
  partial("doubles", {file("tiles/t3.pcd", content)});
  files.push_back("doubles");
  const Result merged = merge(kSameBits, files);
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_TRUE(merged.out == together(kSameBits).out);
}

TEST_F(PcdBvIndependentShares, AreNamedIfTheyCannotBeMerged) {
  const Points points = gaussian(30'000, 4);
  std::filesystem::create_directories(at("tiles"));
  const std::vector<std::string> files = make_tiles(points, {0, 9000, 20'000, 30'000});
  const auto expect_error = [&](const std::vector<std::string>& some, const std::string& problem) {
    const Result result = merge("aabb", some);
    EXPECT_EQ(result.status, 1) << problem;
    EXPECT_THAT(result.err, HasSubstr(problem));
    EXPECT_FALSE(result.json().contains("clusters")) << problem;
  };
  merge_to_file("all", files);
  EXPECT_TRUE(merge("aabb", {"all"}).out == together("aabb").out);
  expect_error({"all", files[0]}, files[0] + ": overlaps another share: is the same file given twice?");
  expect_error({"all", "all"}, "all: overlaps another share");
  merge_to_file("lacks", {files[0], files[1], files[3]});
  expect_error({"lacks"},
               "of 11000 of the inputs that begin with 't2.pcd'. The files are shares of 2 clouds");
  const std::string good = read_file(at("all"));
  file("cut", good.substr(0, good.size() - 1));
  expect_error({"cut"}, "cut: is truncated");
  for (std::size_t i = 0; i < good.size(); i += 1 + good.size() / 50) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 4);
    file("bad", bad);
    expect_error({"bad"}, "bad: ");
  }
  partial("moved", {"--origin", "1,2,3", at("tiles/t1.pcd")});
  expect_error({files[1], "moved"}, "moved: is a share with another --origin");
  partial("near", {"--range", "0:1", at("tiles/t1.pcd")});
  expect_error({files[1], "near"}, "near: is a share with another --range");
  partial("objects", {"--cluster", "1", at("tiles/t1.pcd")});
  expect_error({files[1], "objects"}, "objects: has objects: give --cluster as for --partial");
}

}  // namespace
}  // namespace pcl_bv::test
