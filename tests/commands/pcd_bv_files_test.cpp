// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The files that pcd_bv makes: whole or not at all, and where they belong.

#include <gmock/gmock.h>

#include "command.h"
#include "pcl_bv/io/pcd.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

TEST_F(PcdBv, OutputFileHoldsWhatStandardOutputWould) {
  const std::string cloud = ascii("c.pcd", {"0 0 0", "1 2 3"});
  for (const std::string format : {"text", "json", "jsonl"}) {
    SCOPED_TRACE(format);
    const std::string expected = run({"--format", format, cloud, cloud}).out;
    const Result result = run({"--format", format, "--output", at("out"), cloud, cloud});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(read_file(at("out")), expected);
  }
}

TEST_F(PcdBv, OutputThatCannotBeWrittenIsStatusOneAndOneLine) {
  const std::string cloud = ascii("c.pcd", {"0 0 0"});
  fs::create_directory(at("folder"));
  for (const std::string& output : {at("no/such/folder/out"), at("folder"), cloud + "/out"}) {
    const Result result = run({"--output", output, cloud});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, StartsWith("pcd_bv: " + output + ": "));
    EXPECT_EQ(result.error_lines(), 1u) << result.err;
  }
  EXPECT_TRUE(fs::is_directory(at("folder")));
  EXPECT_TRUE(fs::is_regular_file(cloud));
}

TEST_F(PcdBv, FilesThatCannotBeWrittenLeaveTheReportAndTheOldFiles) {
  const std::string cloud = ascii("c.pcd", {"0 0 0"});
  const std::string blocked = file("blocked", "old");  // a file where a folder would have to be
  for (const std::string option : {"--labels", "--image"}) {
    SCOPED_TRACE(option);
    const std::string target = blocked + (option == "--labels" ? "/x.pcd" : "/x.png");
    const Result result = run({option, target, cloud});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.error_lines(), 1u) << result.err;
    EXPECT_THAT(result.err, StartsWith("pcd_bv: " + target + ": "));
    EXPECT_THAT(result.out, HasSubstr("1 points"));
    EXPECT_EQ(read_file(blocked), "old");
  }
}

TEST_F(PcdBv, FailedInputLeavesOldLabelsAndPicture) {
  const std::string labels = file("l.pcd", "old labels"), image = file("i.png", "old picture");
  EXPECT_EQ(run({"--labels", labels, "--image", image, at("missing.pcd")}).status, 1);
  EXPECT_EQ(read_file(labels), "old labels");
  EXPECT_EQ(read_file(image), "old picture");
}

TEST_F(PcdBv, SeveralInputsPutTheirFilesIntoANewFolder) {
  ascii("in/a.pcd", {"0 0 0", "1 2 3"});
  ascii("in/b.c.pcd", {"0 0 0", "1 2 3"});
  const Result result =
      run({"--labels", at("new/labels"), "--image", at("new/images"), at("in"), "synth:box:500:2"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const std::string stem : {"a", "b.c", "box-500-2"}) {
    EXPECT_GT(read_pcd(at("new/labels/" + stem + ".pcd")).size(), 0u);
    EXPECT_THAT(read_file(at("new/images/" + stem + ".png")), StartsWith("\x89PNG"));
  }
}

TEST_F(PcdBv, FolderOfOneCloudPutsItsFilesIntoAFolderToo) {
  ascii("in/a.pcd", {"0 0 0"});
  EXPECT_EQ(run({"--labels", at("labels"), at("in")}).status, 0);
  EXPECT_TRUE(fs::is_regular_file(at("labels/a.pcd")));
}

TEST_F(PcdBv, TwoResultsForOneFileAreRefusedBeforeAnyWork) {
  const std::string a = ascii("1/x.pcd", {"0 0 0"}), b = ascii("2/x.pcd", {"1 1 1"});
  const Result result = run({"--labels", at("labels"), a, b});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.error_lines(), 1u) << result.err;
  EXPECT_FALSE(fs::exists(at("labels")));
  EXPECT_EQ(run({"--output", at("same.pcd"), "--labels", at("same.pcd"), a}).status, 2);
}

TEST_F(PcdBv, PictureIsTheSameEachTime) {
  const std::vector<std::string> common = {"--range",  "1:60", "--cluster",         "0.5",
                                           "--volume", "all",  "synth:street:16000"};
  const auto picture = [&](const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--image", at(name)});
    arguments.insert(arguments.end(), common.begin(), common.end());
    EXPECT_EQ(run(arguments).status, 0);
    return read_file(at(name));
  };
  const std::string first = picture("a.png", {"--isa", "scalar", "--threads", "1"});
  EXPECT_THAT(first, StartsWith("\x89PNG"));
  EXPECT_EQ(picture("b.png", {"--threads", "2"}), first);
}

TEST_F(PcdBv, OutputToADeviceLeavesTheDevice) {
  const std::string cloud = ascii("c.pcd", {"0 0 0"});
  EXPECT_EQ(run({"--output", "/dev/null", cloud}).status, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace pcl_bv::test
