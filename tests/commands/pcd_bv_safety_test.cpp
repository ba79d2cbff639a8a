// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a slip of the hand must not cost.

#include <gmock/gmock.h>

#include <filesystem>

#include "command.h"

namespace pcl_bv::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(PcdBv, NoOutputEverOverwritesAnInput) {
  const std::string cloud = ascii("good.pcd", {"1 2 3", "4 5 6"});
  const std::string content = read_file(cloud);
  fs::create_directory(at("folder"));
  fs::copy(cloud, at("folder/a.pcd"));
  fs::create_symlink(cloud, at("link.pcd"));
  file("robot.json", "{}");
  file("run.yaml", "threads: 1\n");
  const std::vector<std::vector<std::string>> cases = {
      {"--output", cloud, cloud},
      {"--labels", cloud, cloud},
      {"--labels", at("folder"), at("folder")},
      {"--labels", at("folder/../good.pcd"), cloud},
      {"--labels", at("link.pcd"), cloud},
      {"--labels", cloud, at("link.pcd")},
      {"--output", at("robot.json"), "--drop-inside", at("robot.json"), cloud},
      {"--output", at("run.yaml"), "--config", at("run.yaml"), cloud},
  };
  for (const auto& arguments : cases) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("is an input and would be overwritten"));
    EXPECT_EQ(read_file(cloud), content);
    EXPECT_EQ(read_file(at("folder/a.pcd")), content);
  }
}

TEST_F(PcdBv, APictureIsAPngOrAnSvgOrRefused) {
  const std::string cloud = ascii("good.pcd", {"1 2 3", "4 5 6"});
  const auto status = [&](const std::string& image) { return run({"--image", at(image), cloud}).status; };
  EXPECT_EQ(status("a.jpg"), 2);
  EXPECT_EQ(status("a.pdf"), 2);
  EXPECT_EQ(status("good.pcd"), 2);
  EXPECT_EQ(status("a.PNG"), 0);
  EXPECT_EQ(status("a.SVG"), 0);
  EXPECT_TRUE(fs::exists(at("a.PNG")));
  EXPECT_TRUE(fs::exists(at("a.SVG")));
}

TEST_F(PcdBv, AProblemIsOneLineWhateverTheNameHolds) {
  const Result result = run({at("two\nlines\x1b[31m.pcd")});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.error_lines(), 1U);
  EXPECT_THAT(result.err, HasSubstr("two?lines?[31m.pcd: "));
}

TEST_F(PcdBv, FilesAreWrittenThoughNobodyReadsTheReport) {
  std::vector<std::string> arguments = {"--format", "jsonl", "--labels", at("labels")};
  for (const char* name : {"a.pcd", "b.pcd", "c.pcd"})
    arguments.push_back(ascii(name, {"1 2 3"}));
  Surroundings surroundings;
  surroundings.nobody_reads = true;
  const Result result = run(arguments, surroundings);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  for (const char* name : {"labels/a.pcd", "labels/b.pcd", "labels/c.pcd"})
    EXPECT_TRUE(fs::exists(at(name)));
}

}  // namespace
}  // namespace pcl_bv::test
