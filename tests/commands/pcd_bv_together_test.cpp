// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One cloud in many files: --together, --partial, --merge.

#include <gmock/gmock.h>

#include "tiles.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

class PcdBvTogether : public Tiled {
 protected:
  Result together(const std::string& volumes, const std::vector<std::string>& inputs) const {
    std::vector<std::string> arguments{"--together", "--format", "jsonl", "--volume", volumes};
    arguments.insert(arguments.end(), inputs.begin(), inputs.end());
    return run(arguments);
  }

  std::vector<std::string> shares(std::size_t count, const std::string& inputs) const {
    std::vector<std::string> files;
    for (std::size_t i = 0; i < count; ++i) {
      files.push_back(at("share" + std::to_string(count) + "_" + std::to_string(i)));
      const std::string part = std::to_string(i) + "/" + std::to_string(count);
      const Result result = run({"--partial", files.back(), "--part", part, inputs});
      EXPECT_EQ(result.status, 0) << result.err;
      EXPECT_EQ(result.out, "");
      EXPECT_LT(std::filesystem::file_size(files.back()), 1U << 20);
    }
    return files;
  }

  Result merge(const std::string& volumes, const std::vector<std::string>& files) const {
    std::vector<std::string> arguments{"--merge", "--format", "jsonl", "--volume", volumes};
    arguments.insert(arguments.end(), files.begin(), files.end());
    return run(arguments);
  }
};

TEST_F(PcdBvTogether, HasTheBitsOfOneFileForEveryMethod) {
  const Points points = gaussian(90'000, 1);
  const std::string whole = binary("whole.pcd", points);
  const Json expected = found(run({"--format", "jsonl", "--volume", "all,hull,best", whole}));
  EXPECT_EQ(expected["counts"]["nonfinite"], 900);
  for (const std::size_t count : {1UL, 2UL, 9UL, 64UL}) {
    const std::string folder = tiles("tiles" + std::to_string(count), points, count);
    const Result result = together("all,hull,best", {folder});
    EXPECT_TRUE(found(result) == expected) << count;
    EXPECT_EQ(result.json()["file"], "together");
    EXPECT_EQ(result.json()["parts"], count);
    EXPECT_EQ(result.err, "");
  }
}

TEST_F(PcdBvTogether, OfFewPointsAndOfNoneIsAsOneFile) {
  for (const std::size_t size : {0UL, 1UL, 2UL, 700UL, 4200UL}) {
    const Points points = gaussian(size, 2);
    const std::string name = std::to_string(size);
    const std::string whole = binary("whole" + name + ".pcd", points);
    const std::string folder = tiles("tiles" + name, points, 6);
    const Json expected = found(run({"--format", "jsonl", "--volume", "all,hull", whole}));
    EXPECT_TRUE(found(together("all,hull", {folder})) == expected) << size;
    const Json served = found(run({"--format", "jsonl", "--volume", kServed, whole}));
    EXPECT_TRUE(found(merge(kServed, shares(3, folder))) == served) << size;
  }
}

TEST_F(PcdBvTogether, CountsThroughTheInputsInTheirOrder) {
  // The ends of a flat side are the points with the least numbers, and they seed the boxes of DiTO.
  Points points = gaussian(50'000, 3);
  for (auto& p : points) {
    for (float& c : p)
      c = std::clamp(c, -0.5F, 0.5F);
  }
  const Points first(points.begin(), points.begin() + 20'000), second(points.begin() + 20'000, points.end());
  const std::string a = binary("z.pcd", first), b = binary("a.pcd", second);
  const std::string whole = binary("whole.pcd", points);
  EXPECT_TRUE(found(together("all,hull", {a, b})) ==
              found(run({"--format", "jsonl", "--volume", "all,hull", whole})));
}

TEST_F(PcdBvTogether, TakesAllAsDoublesIfOneInputHasThem) {
  const Points points = gaussian(60'000, 4);
  std::vector<double> wide;
  for (const auto& p : points)
    wide.insert(wide.end(), p.begin(), p.end());
  const auto doubles = [&](std::size_t begin, std::size_t end) {
    std::string text = header(end - begin, "binary");
    text.replace(text.find("SIZE 4 4 4"), 10, "SIZE 8 8 8");
    return text.append(reinterpret_cast<const char*>(wide.data() + 3 * begin), (end - begin) * 24);
  };
  const std::string whole = file("whole.pcd", doubles(0, 60'000));
  const std::string a = file("a.pcd", doubles(0, 1000));
  const std::string b = binary("b.pcd", Points(points.begin() + 1000, points.end()));
  EXPECT_TRUE(found(together("all,hull", {a, b})) ==
              found(run({"--format", "jsonl", "--volume", "all,hull", whole})));
}

TEST_F(PcdBvTogether, FiltersShiftsAndChecksAsOneFile) {
  const Points points = gaussian(70'000, 5);
  const std::string whole = binary("whole.pcd", points);
  const std::string folder = tiles("tiles", points, 12);
  const std::vector<std::string> options{"--format", "jsonl",   "--volume", "aabb,sphere,obb-pca",
                                         "--check",  "--range", "0.3:1.1",  "--origin",
                                         "auto"};
  std::vector<std::string> one = options, many = options;
  one.push_back(whole);
  many.insert(many.end(), {"--together", folder});
  const Json expected = found(run(one));
  EXPECT_GT(expected["counts"]["range"], 1000);
  EXPECT_EQ(expected["clusters"][0]["volumes"][0]["outside"], 0);
  EXPECT_TRUE(found(run(many)) == expected);

  std::vector<std::string> files;
  for (const std::string part : {"0/3", "1/3", "2/3"}) {
    files.push_back(at("p" + part.substr(0, 1)));
    ASSERT_EQ(
        run({"--partial", files.back(), "--part", part, "--range", "0.3:1.1", "--origin", "1,2,3", folder})
            .status,
        0);
  }
  EXPECT_TRUE(found(merge("aabb,sphere,obb-pca", files)) ==
              found(run({"--format", "jsonl", "--volume", "aabb,sphere,obb-pca", "--range", "0.3:1.1",
                         "--origin", "1,2,3", whole})));
}

TEST_F(PcdBvTogether, SaysSoInTheTextAndCsvAndWritesMeshAndPicture) {
  const std::string folder = tiles("tiles", gaussian(40'000, 6), 5);
  const Result text = run({"--together", "--mesh", at("m.ply"), "--image", at("i.png"), "--info", folder});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("together: 5 inputs, 40000 points, 400 not finite\n"));
  EXPECT_TRUE(std::filesystem::exists(at("m.ply")));
  EXPECT_TRUE(std::filesystem::exists(at("i.png")));
  EXPECT_THAT(run({"--together", "--format", "csv", folder}).out, HasSubstr("\ntogether,0,39600,aabb,"));
}

TEST_F(PcdBvTogether, ShowsHowManyPointsItHasRead) {
  if (!has_terminals()) GTEST_SKIP() << "no terminals here";
  const Result result =
      run({"--together", "--progress", "synth:gauss:3000000", "synth:gauss:3000000:2"}, {.terminal = true});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("2 files, "));
  EXPECT_THAT(result.err, testing::ContainsRegex(" M points read in all passes, [0-9.]+ s, [1-9][0-9]* MB"));
  const Result share =
      run({"--partial", at("share"), "--progress", "synth:gauss:6000000"}, {.terminal = true});
  EXPECT_THAT(share.err,
              testing::ContainsRegex("[0-9.]+ M points read in all passes, [0-9.]+ s, [1-9][0-9]* MB"));
}

TEST_F(PcdBvTogether, LeavesOutAnInputThatFailsAndNamesIt) {
  const Points points = gaussian(60'000, 7);
  const std::string folder = tiles("tiles", points, 8);
  const Json expected = found(together("all", {folder}));
  add_bad_tiles("tiles");
  const Result result = together("all", {folder});
  expect_bad_tiles_named(result, "tiles");
  Json report = result.json();
  EXPECT_EQ(report["parts"], 8);
  expect_bad_tiles_listed(report, "tiles");
  EXPECT_TRUE(report["clusters"] == expected["clusters"]);
  EXPECT_EQ(report["points"], 60'000);

  const Result partial = run({"--partial", at("p"), folder});
  EXPECT_EQ(partial.status, 1);
  EXPECT_FALSE(std::filesystem::exists(at("p")));

  const Result nothing = together("aabb", {file("x.pcd", "no cloud"), at("not there.pcd")});
  EXPECT_EQ(nothing.status, 1);
  EXPECT_EQ(nothing.json()["error"], "no input could be read");
}

TEST_F(PcdBvTogether, RefusesWhatNeedsOneCloudInMemory) {
  const std::string folder = tiles("tiles", gaussian(100, 8), 2);
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--ground", "plane"}, {"--labels", "l.pcd"}}) {
    for (const std::vector<std::string>& kind :
         {std::vector<std::string>{"--together"}, {"--partial", "p"}, {"--merge"}}) {
      std::vector<std::string> arguments = kind;
      arguments.insert(arguments.end(), options.begin(), options.end());
      arguments.push_back(folder);
      const Result result = run(arguments);
      EXPECT_EQ(result.status, 2) << result.err;
      EXPECT_THAT(result.err, HasSubstr(kind.front() + ": cannot be combined with " + options.front()));
    }
  }
}

TEST_F(PcdBvTogether, SharesMergeToItsBitsInAnyOrderForEveryMethodThatTheyServe) {
  const Points points = gaussian(100'000, 9);
  const std::string folder = tiles("tiles", points, 20);
  const std::string expected = together(kServed, {folder}).out;
  std::mt19937 random(9);
  for (const std::size_t count : {1UL, 2UL, 7UL, 64UL}) {
    std::vector<std::string> files = shares(count, folder);
    for (int order = 0; order < 3; ++order) {
      std::shuffle(files.begin(), files.end(), random);
      const Result merged = merge(kServed, files);
      EXPECT_EQ(merged.status, 0) << merged.err;
      EXPECT_TRUE(merged.out == expected) << count;
    }
    if (count < 2) continue;
    const std::vector<std::string> half(files.begin(),
                                        files.begin() + static_cast<std::ptrdiff_t>(count / 2));
    std::vector<std::string> arguments{"--merge", "--partial", at("half")};
    arguments.insert(arguments.end(), half.begin(), half.end());
    ASSERT_EQ(run(arguments).status, 0);
    std::vector<std::string> rest(files.begin() + static_cast<std::ptrdiff_t>(count / 2), files.end());
    rest.push_back(at("half"));
    EXPECT_TRUE(merge(kServed, rest).out == expected) << count;
  }
}

TEST_F(PcdBvTogether, SharesOfOneFileAreRangesOfIt) {
  const std::string whole = binary("whole.pcd", gaussian(200'000, 10));
  const std::vector<std::string> files = shares(3, whole);
  std::size_t bytes = 0;
  for (const std::string& name : files)
    bytes += read_file(name).size();
  EXPECT_GT(bytes, 3U * 2000);  // each has points
  EXPECT_TRUE(found(merge(kServed, files)) == found(run({"--format", "jsonl", "--volume", kServed, whole})));
}

TEST_F(PcdBvTogether, MergesAFolderOfShares) {
  const std::string whole = binary("whole.pcd", gaussian(10'000, 11));
  std::filesystem::create_directories(at("shares"));
  for (const std::string k : {"0", "1"})
    ASSERT_EQ(run({"--partial", at("shares/" + k), "--part", k + "/2", whole}).status, 0);
  EXPECT_TRUE(merge("aabb", {at("shares")}).out == together("aabb", {whole}).out);
}

class PcdBvMerge : public PcdBvTogether {
 protected:
  PcdBvMerge() : whole_(binary("whole.pcd", gaussian(70'000, 12))), files_(shares(2, whole_)) {}

  void expect_refused(const std::vector<std::string>& files, const std::string& problem) const {
    const Result result = merge("aabb", files);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr(problem));
    EXPECT_EQ(result.json().contains("clusters"), false);
  }

  std::string whole_;
  std::vector<std::string> files_;
};

TEST_F(PcdBvMerge, RefusesSharesThatAreMissingTwiceOrOfAnotherCloud) {
  expect_refused({files_[1]}, "shares are missing: points 0 to 32768 of 70000");
  expect_refused({files_[0], files_[1], files_[1]}, "is the same file given twice?");
  const std::string other = binary("other.pcd", gaussian(70'000, 13));
  ASSERT_EQ(run({"--partial", at("other"), "--part", "1/2", other}).status, 0);
  expect_refused({files_[0], at("other")},
                 "shares are missing: points 0 to 32768 of 70000 of the inputs that "
                 "begin with 'other.pcd'. The files are shares of 2 clouds");
  ASSERT_EQ(run({"--partial", at("moved"), "--part", "1/2", "--origin", "1,2,3", whole_}).status, 0);
  expect_refused({files_[0], at("moved")}, "another --origin");
  ASSERT_EQ(run({"--partial", at("near"), "--part", "1/2", "--range", "0:1", whole_}).status, 0);
  expect_refused({files_[0], at("near")}, "another --range");
}

TEST_F(PcdBvMerge, RefusesFilesThatAreCutChangedNewerOrNone) {
  const std::string good = read_file(files_[0]);
  expect_refused({file("cut", good.substr(0, good.size() - 1)), files_[1]}, "cut: is damaged");
  std::string bad = good;
  bad[good.size() / 2] = static_cast<char>(bad[good.size() / 2] ^ 1);
  expect_refused({file("bad", bad), files_[1]}, "bad: is damaged");
  std::string newer = good;
  newer[std::string("pcl_bv partial results ").size()] = '3';
  expect_refused({file("newer", newer), files_[1]}, "newer: was written by another version");
  expect_refused({whole_, files_[1]}, "whole.pcd: is no file of partial results");
  expect_refused({at("nowhere"), files_[1]}, "nowhere: ");
}

TEST_F(PcdBvMerge, RefusesMethodsAndOptionsThatNeedThePoints) {
  for (const char* method : {"sphere-ritter", "sphere-epos26", "obb-lshape", "all"}) {
    EXPECT_EQ(merge(method, files_).status, 2) << method;
    const Result result = run({"--partial", at("p"), "--volume", method, whole_});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("needs all points"));
  }
  for (const char* option : {"--check", "--info"}) {
    EXPECT_EQ(run({"--merge", option, files_[0], files_[1]}).status, 2);
    EXPECT_EQ(run({"--partial", at("p"), option, whole_}).status, 2);
  }
  EXPECT_EQ(run({"--partial", at("p"), "--origin", "auto", whole_}).status, 2);
  EXPECT_EQ(run({"--part", "0/2", whole_}).status, 2);
  for (const char* part : {"2/2", "1", "-1/2", "0/0", "a/b", "0/2x"})
    EXPECT_EQ(run({"--partial", at("p"), "--part", part, whole_}).status, 2) << part;
  EXPECT_EQ(run({"--partial", whole_, whole_}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(at("p")));
}

TEST_F(PcdBvMerge, SaysWhichFileItCannotWrite) {
  const Result result = run({"--partial", at("shares_are_no_folder"), whole_});
  ASSERT_EQ(result.status, 0);
  const Result denied = run({"--partial", at("shares_are_no_folder/p"), whole_});
  EXPECT_EQ(denied.status, 1);
  EXPECT_THAT(denied.err, HasSubstr("shares_are_no_folder"));
}

}  // namespace
}  // namespace pcl_bv::test
