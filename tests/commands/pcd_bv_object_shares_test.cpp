// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects of clouds that are processed in shares: --partial and --merge with --cluster.

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "tiled_objects.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

class PcdBvObjectShares : public TiledObjects {
 protected:
  static std::streamoff size_of(const std::string& path) {
    return static_cast<std::streamoff>(std::filesystem::file_size(path));
  }

  // Changes a byte in each 10 000 from the middle of a file on, which are points.
  void damage_all_points(const std::string& path) const {
    const std::streamoff size = size_of(path);
    for (std::streamoff at = size / 2; at > size / 3; at -= 10'000)
      damage(path, at);
  }

  // Returns the position from the end of a file where a text begins first.
  static std::streamoff from_end_of(const std::string& path, const std::string& text) {
    const std::string content = read_file(path);
    return static_cast<std::streamoff>(content.size() - content.find(text));
  }

  // Changes the byte at a position from the end of a file.
  void damage(const std::string& path, std::streamoff from_end) const {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(-from_end, std::ios::end);
    const int byte = file.get();
    file.seekp(-from_end, std::ios::end);
    file.put(static_cast<char>(byte ^ 64));
  }
};

TEST_F(PcdBvObjectShares, GiveTheBytesOfOneProcessForAnySharesAndMemory) {
  const std::vector<std::vector<std::string>> options = cluster_options();
  for (unsigned seed = 1; seed <= options.size(); ++seed) {
    SCOPED_TRACE(seed);
    const std::string name = std::to_string(seed), folder = tiles("tiles" + name, yard(seed), 6);
    const Result expected = objects(options[seed - 1], {"--together"}, folder);
    for (const std::size_t count : {1UL, 2UL, 5UL}) {
      const std::string parts =
          shares("parts" + name + "_" + std::to_string(count), count, options[seed - 1], {folder});
      for (const char* const memory : {"1", "600"}) {
        const Result merged = objects(options[seed - 1], {"--merge", "--memory", memory}, parts);
        EXPECT_EQ(merged.status, 0) << merged.err;
        EXPECT_TRUE(merged.out == expected.out) << count << " shares, " << memory << " MB";
      }
    }
  }
}

TEST_F(PcdBvObjectShares, AreFittedAgainForOtherVolumesAndChecked) {
  const std::string folder = tiles("tiles", yard(1), 6);
  const std::string parts = shares("parts", 3, {"--cluster", "0.4", "--volume", "aabb"}, {folder});
  const std::vector<std::string> other = {"--cluster", "0.4", "--volume", "dop14,obb-pca"};
  EXPECT_EQ(objects(other, {"--merge"}, parts).out, objects(other, {"--together"}, folder).out);
  const std::vector<std::string> sizes = {"--cluster", "0.4", "--min-size", "100", "--volume", "aabb"};
  EXPECT_EQ(objects(sizes, {"--merge"}, parts).out, objects(sizes, {"--together"}, folder).out);
  const std::vector<std::string> same = {"--cluster", "0.4", "--volume", "aabb"};
  EXPECT_EQ(objects(same, {"--merge", "--check"}, parts).out,
            objects(same, {"--together", "--check"}, folder).out);
}

TEST_F(PcdBvObjectShares, OfIndependentInputsAreOneCloudInTheOrderOfTheirNames) {
  const Points points = yard(2);
  const std::vector<std::string> options = {"--cluster", "0.4", "--volume", "aabb,obb-lshape"};
  const std::size_t third = points.size() / 3;
  std::vector<std::string> together = {"--together", "--format", "jsonl"};
  together.insert(together.end(), options.begin(), options.end());
  std::filesystem::create_directory(at("parts"));
  for (const std::size_t i : {0UL, 1UL, 2UL}) {
    const std::string tile = i == 2 ? "t10" : "t" + std::to_string(i + 1);
    together.push_back(binary(
        tile + ".pcd",
        Points(points.begin() + static_cast<std::ptrdiff_t>(i * third),
               i == 2 ? points.end() : points.begin() + static_cast<std::ptrdiff_t>((i + 1) * third))));
    shares("parts/" + tile, i + 1, options, {together.back()});
  }
  std::vector<std::string> parts = {"t1/0", "t2/0", "t2/1", "t10/0", "t10/1", "t10/2"};
  const std::string expected = run(together).out;
  std::mt19937 random(2);
  for (int order = 0; order < 4; ++order) {
    std::shuffle(parts.begin(), parts.end(), random);
    const std::string pair = at("pair" + std::to_string(order));
    const Result paired = run(
        {"--merge", "--partial", pair, "--cluster", "0.4", at("parts/" + parts[0]), at("parts/" + parts[1])});
    EXPECT_EQ(paired.status, 0) << paired.err;
    std::vector<std::string> all = {"--merge", "--format", "jsonl", pair};
    all.insert(all.end(), options.begin(), options.end());
    for (std::size_t i = 2; i < parts.size(); ++i)
      all.push_back(at("parts/" + parts[i]));
    const Result merged = run(all);
    EXPECT_EQ(merged.status, 0) << merged.err;
    EXPECT_TRUE(merged.out == expected) << order;
  }
}

TEST_F(PcdBvObjectShares, MergeToOneFileThatMergesAgain) {
  const std::string folder = tiles("tiles", yard(3), 6);
  const std::vector<std::string> options = {"--cluster", "0.4", "--volume", "aabb"};
  const std::string parts = shares("parts", 4, options, {folder});
  for (const char* const pair : {"0", "2"}) {
    const int first = *pair - '0';
    const Result result = run({"--merge", "--partial", at("pairs/" + std::string(pair)), "--cluster", "0.4",
                               parts + "/" + std::to_string(first + 1), parts + "/" + std::to_string(first)});
    EXPECT_EQ(result.status, 0) << result.err;
  }
  EXPECT_EQ(objects(options, {"--merge"}, at("pairs")).out, objects(options, {"--together"}, folder).out);
}

TEST_F(PcdBvObjectShares, NameFilesThatCannotBeMerged) {
  const std::string folder = tiles("tiles", yard(1), 6);
  const std::vector<std::string> options = {"--cluster", "0.4", "--volume", "aabb"};
  const auto expect_error = [&](const std::string& parts, const std::string& what) {
    const Result result = objects(options, {"--merge"}, parts);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr(what));
  };
  const std::string truncated = shares("truncated", 2, options, {folder});
  std::filesystem::resize_file(truncated + "/1", std::filesystem::file_size(truncated + "/1") - 10);
  expect_error(truncated, "truncated/1: is truncated");
  const std::string twice = shares("twice", 2, options, {folder});
  std::filesystem::copy(twice + "/0", twice + "/2");
  expect_error(twice, "twice/2: overlaps another share");
  const std::string missing = shares("missing", 2, options, {folder});
  std::filesystem::remove(missing + "/0");
  expect_error(missing, "shares are missing: points 0 to ");
  const std::string other = shares("other", 2, {"--cluster", "0.5", "--volume", "aabb"}, {folder});
  expect_error(other, "other/0: was made with --cluster 0.5 --min-points 1");
  const std::string index = shares("index", 2, options, {folder});
  std::filesystem::resize_file(index + "/0", 3000);
  expect_error(index, "index/0: is truncated");
  const std::string whole = shares("whole", 1, {"--volume", "aabb"}, {folder});
  expect_error(whole, "whole/0: is no file of objects");
  const std::string damaged = shares("damaged", 2, options, {folder});
  damage(damaged + "/0", 40);  // the index is last
  expect_error(damaged, "damaged/0: is damaged");
  const std::string long_index = shares("long", 2, options, {folder}),
                    huge_index = shares("huge", 2, options, {folder});
  const std::streamoff runs = 56;                                    // byte of the number of runs
  damage(long_index + "/0", size_of(long_index + "/0") - runs - 3);  // 2^30 more
  expect_error(long_index, "long/0: is truncated");
  damage(huge_index + "/0", size_of(huge_index + "/0") - runs - 5);  // 2^46 more
  expect_error(huge_index, "huge/0: is damaged: its index is too large");
  const std::string volume = shares("volume", 2, options, {folder});
  damage(volume + "/1", from_end_of(volume + "/1", R"("volumes":)"));
  const Result fitted = objects(options, {"--merge"}, volume);
  EXPECT_EQ(fitted.status, 1);
  EXPECT_THAT(fitted.err,
              HasSubstr("volume/1: is damaged: a volume has changed: such volumes are fitted again"));
  EXPECT_TRUE(fitted.out == objects(options, {"--together"}, folder).out);
  for (const std::string& parts : {truncated, twice, damaged, long_index, huge_index, volume})
    EXPECT_EQ(objects(options, {"--merge"}, parts).error_lines(), 1U);
}

TEST_F(PcdBvObjectShares, ThatAreDamagedLeaveObjectsThatAreRightOrIncomplete) {
  const std::string folder = tiles("tiles", yard(1), 6);
  const std::vector<std::string> options = {"--cluster", "0.4", "--volume", "aabb"};
  const Json expected = objects(options, {"--together"}, folder).json();
  const std::string points = shares("points", 3, options, {folder});
  damage_all_points(points + "/1");
  const Result result = objects(options, {"--merge"}, points);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("points/1: its points are damaged: "));
  EXPECT_EQ(result.error_lines(), 1U) << result.err;
  std::set<std::string> right;
  for (const Json& object : expected["clusters"])
    right.insert(object["volumes"].dump());
  std::size_t complete = 0, incomplete = 0;
  const Json report = result.json();
  for (const Json& object : report["clusters"]) {
    const bool lacks = object.contains("incomplete");
    EXPECT_TRUE(lacks || right.contains(object["volumes"].dump())) << object;
    ++(lacks ? incomplete : complete);
  }
  EXPECT_GT(complete, 10U);
  EXPECT_GT(incomplete, 0U);
}

TEST_F(PcdBvObjectShares, RefuseWhatTheyDoNotHave) {
  const std::string folder = tiles("tiles", gaussian(100, 8), 2);
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--ground", "slope"}, {"--objects", at("o")}, {"--labels", at("l")}, {"--check"}}) {
    const Result result = objects(options, {"--cluster", "1", "--partial", at("p")}, folder);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
  }
}

}  // namespace
}  // namespace pcl_bv::test
