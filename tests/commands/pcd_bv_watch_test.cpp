// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files that arrive while the command runs.

#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>
#include <utility>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

class PcdBvWatch : public PcdBv {
 protected:
  /// Runs `arrive` in the folder `in` while the command watches it, and then sends SIGTERM.
  Result watch(const std::string& arrive, std::vector<std::string> options = {"--format", "jsonl"}) const {
    std::filesystem::create_directory(at("in"));
    options.insert(options.begin(), {"--watch", at("in"), "--volume", "aabb"});
    return run(options, {.meanwhile = [&](int process) {
                 const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); };
                 for (int i = 0;
                      i < 500 && read_file(at("captured.err")).find("watching") == std::string::npos; ++i)
                   pause();
                 const std::string script = "cd '" + at("in") + "'; " + arrive;
                 EXPECT_EQ(std::system(script.c_str()), 0);
                 // Files are processed within milliseconds: after 800 ms without output all are done.
                 std::size_t written = 0;
                 for (int quiet = 0; quiet < 40; ++quiet) {
                   pause();
                   const std::size_t now =
                       read_file(at("captured.out")).size() + read_file(at("captured.err")).size();
                   if (std::exchange(written, now) != now) quiet = 0;
                 }
                 kill(process, SIGTERM);
               }});
  }

  static std::string cloud(const std::string& name) {
    return "printf 'VERSION .7\\nFIELDS x y z\\nSIZE 4 4 4\\nTYPE F F F\\nWIDTH 1\\nPOINTS 1\\nDATA "
           "ascii\\n1 2 3\\n' >" +
           name + "; ";
  }
  static std::vector<std::string> files_of(const std::string& lines) {
    std::vector<std::string> names;
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);)
      names.push_back(std::filesystem::path(Json::parse(line)["file"].get<std::string>()).filename());
    return names;
  }
};

TEST_F(PcdBvWatch, ProcessesFilesThatAreCompleteInTheOrderOfArrival) {
  const Result result = watch(cloud("b.pcd") + cloud("part.tmp") + cloud(".hidden.pcd") +
                              "mv part.tmp a.pcd; mkdir c.pcd; " + cloud("notes.txt"));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(files_of(result.out), testing::ElementsAre("b.pcd", "a.pcd"));
  EXPECT_THAT(result.err, HasSubstr("watching " + at("in") + "\n"));
  EXPECT_THAT(result.err, HasSubstr("2 files: 2 done, 0 failed\n"));
}

// The file is so large that its mode changes while it is read. Without another attempt, some of the 20 fail.
TEST_F(PcdBvWatch, ReadsAFileWhoseModeIsChangedAfterItIsClosed) {
  ASSERT_EQ(run({"gauss:1000000", at("large.pcd")}, {.program = "synth"}).status, 0);
  std::string script;
  for (int i = 0; i < 20; ++i) {
    const std::string name = "a" + std::to_string(10 + i) + ".pcd";
    script += "cp ../large.pcd " + name + "; chmod 600 " + name + "; ";
  }
  const Result result = watch(script);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(files_of(result.out).size(), 20U);
}

TEST_F(PcdBvWatch, DoesNotReadAFileThatIsStillOpen) {
  const Result result =
      watch("exec 3>slow.pcd; printf 'VERSION' >&3; sleep 0.5; exec 3>&-; sleep 0.2; " + cloud("slow.pcd"));
  EXPECT_THAT(files_of(result.out), testing::ElementsAre("slow.pcd", "slow.pcd"));  // closed twice
  EXPECT_EQ(result.status, 1);
}

TEST_F(PcdBvWatch, GoesOnAfterADamagedFileAndEndsWithItsStatus) {
  const Result result =
      watch("echo bad >1.pcd; " + cloud("2.pcd"), {"--format", "json", "--labels", at("out")});
  EXPECT_EQ(result.status, 1);
  const Json reports = Json::parse(result.out);
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_TRUE(reports[0].contains("error"));
  EXPECT_EQ(reports[1]["points"], 1);
  EXPECT_TRUE(std::filesystem::exists(at("out/2.pcd")));
}

TEST_F(PcdBvWatch, ReadsTextWithColumnsAndKeepsFramesApart) {
  const Result result =
      watch("echo 1 2 3 >a.xyz; echo 4 5 6 >b.xyz", {"--columns", "x,y,z", "--format", "kitti-tracking"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, testing::StartsWith("0 -1 Misc"));
  EXPECT_THAT(result.out, HasSubstr("\n1 -1 Misc"));
}

TEST_F(PcdBvWatch, EndsIfTheFolderIsRemoved) {
  const Result result = watch("rmdir ../in");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("in: the folder is gone"));
}

TEST_F(PcdBvWatch, RefusesWhatItCannotDo) {
  const auto error = [&](const std::vector<std::string>& arguments, int status = 2) {
    const Result result = run(arguments);
    EXPECT_EQ(result.status, status);
    return result.err;
  };
  std::filesystem::create_directory(at("in"));
  EXPECT_THAT(error({"--watch", at("missing")}, 1), HasSubstr("missing: cannot be watched: no such file"));
  EXPECT_THAT(error({"--watch", at("in"), "a.pcd"}), HasSubstr("the only inputs"));
  EXPECT_THAT(error({"--watch", at("in"), "--labels", at("in")}), HasSubstr("another folder"));
  EXPECT_THAT(error({"--watch", at("in"), "--format", "sustech"}), HasSubstr("--format sustech"));
  EXPECT_THAT(error({"--watch", at("in"), "--output", "x.json"}), HasSubstr("--output"));
}

}  // namespace
}  // namespace pcl_bv::test
