// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Names of files: links, detours, bytes that are no text, stems that meet.

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "command.h"
#include "devices.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(PcdBv, LinksToFilesAndFoldersAreFollowed) {
  ascii("folder/a.pcd", {"1 2 3"});
  fs::create_symlink(at("folder/a.pcd"), at("folder/b.pcd"));
  fs::create_directory_symlink(at("folder"), at("link"));
  const Json reports = run({"--format", "json", at("folder/b.pcd"), at("link")}).json();
  ASSERT_EQ(reports.size(), 3U);
  EXPECT_EQ(reports[0]["file"], at("folder/b.pcd"));
  EXPECT_EQ(reports[1]["file"], at("link/a.pcd"));
  EXPECT_EQ(reports[2]["file"], at("link/b.pcd"));
  for (const Json& report : reports)
    EXPECT_EQ(report["points"], 1);
}

TEST_F(PcdBv, AnOutputThatIsALinkStaysOne) {
  const std::string cloud = ascii("c.pcd", {"1 2 3"}), old = file("old.pcd", "old");
  fs::create_symlink(old, at("link.pcd"));
  EXPECT_EQ(run({"--labels", at("link.pcd"), cloud}).status, 0);
  EXPECT_TRUE(fs::is_symlink(at("link.pcd")));
  EXPECT_EQ(read_pcd(old).size(), 1U);
}

TEST_F(PcdBv, ExtensionsMayBeWrittenInCapitals) {
  EXPECT_EQ(run({ascii("A.PCD", {"1 2 3"})}).status, 0);
  EXPECT_EQ(run({file("B.Bin", std::string(16, '\0'))}).status, 0);
}

TEST_F(PcdBv, ANameThatBeginsWithADashComesAfterTwo) {
  const std::string cloud = ascii("c.pcd", {"1 2 3"});
  const Result result = run({"--", "-c.pcd", cloud});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("pcd_bv: -c.pcd: no such file or directory\n"));
  EXPECT_EQ(run({"-c.pcd", cloud}).status, 2);
}

TEST_F(PcdBv, AnyNameKeepsEveryFormatWhole) {
  for (const std::string name :
       {"two\nlines.pcd", "comma,quote\".pcd", "od\xff\xfe.pcd", "\x1b[31m.pcd", " .pcd"}) {
    SCOPED_TRACE(name);
    const std::string cloud = ascii(name, {"1 2 3"});
    const Json report = run({"--format", "jsonl", "--labels", at("labels/"), cloud}).json();
    EXPECT_EQ(report["points"], 1);
    if (name.find('\xff') == std::string::npos) {
      EXPECT_EQ(report["file"], cloud);
    }
    const std::string text = run({"--volume", "aabb", cloud}).out;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << text;
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    const std::string csv = run({"--format", "csv", "--volume", "aabb", cloud}).out;
    EXPECT_THAT(csv, HasSubstr(",0,1,aabb,1,2,3,0,0,0,"));
  }
}

TEST_F(PcdBv, FilesOfAnyNameGoIntoTheFolder) {
  const std::string odd = ascii("in/od\xff\n.pcd", {"1 2 3"});
  const Result result = run({"--labels", at("out"), "--mesh", at("out"), "--image", at("out"), at("in")});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* extension : {".pcd", ".ply", ".png"})
    EXPECT_TRUE(fs::exists(at(std::string("out/od\xff\n") + extension)));
}

TEST_F(PcdBv, TwoInputsOfOneStemAreRefusedForEveryKindOfFile) {
  const std::string a = ascii("x.pcd", {"1 2 3"}), b = file("x.bin", std::string(16, '\0'));
  for (const std::string option : {"--labels", "--mesh", "--image"}) {
    for (const std::string& second : {b, a}) {
      const Result result = run({option, at("new"), a, second});
      EXPECT_EQ(result.status, 2);
      EXPECT_THAT(result.err, HasSubstr("more than one result would be written to this file"));
      EXPECT_FALSE(fs::exists(at("new")));
    }
  }
  EXPECT_EQ(run({a, b, a}).status, 0);
}

TEST_F(PcdBv, TwoOutputsIntoOneFileAreRefusedButDevicesTakeAll) {
  const std::string cloud = ascii("x.pcd", {"1 2 3"});
  EXPECT_EQ(run({"--output", at("same.pcd"), "--labels", at("./same.pcd"), cloud}).status, 2);
  const std::string null = device_in(at(""), Device::null).string();
  if (null.empty()) GTEST_SKIP() << "no device can be made";
  EXPECT_EQ(run({"--output", null, "--labels", null, cloud}).status, 0);
}

}  // namespace
}  // namespace pcl_bv::test
