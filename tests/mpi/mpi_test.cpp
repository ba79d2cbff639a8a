// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// pcd_bv over ranks, which share this machine's processors.

#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <thread>

#include "tiled_objects.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

// The line of a file in /proc of which one variable or number is wanted.
std::string proc(int process, const std::string& name) {
  return read_file("/proc/" + std::to_string(process) + "/" + name);
}

// The process that is this rank of the run that `launcher` and its children are, once it is there.
std::optional<int> process_of_rank(int launcher, int rank) {
  std::istringstream children(proc(launcher, "task/" + std::to_string(launcher) + "/children"));
  const std::string wanted = std::string("\0OMPI_COMM_WORLD_RANK=", 22) + std::to_string(rank) + '\0';
  for (int child; children >> child;) {
    if (proc(child, "comm") == "pcd_bv_mpi\n" && proc(child, "environ").find(wanted) != std::string::npos)
      return child;
    if (const auto found = process_of_rank(child, rank)) return found;
  }
  return std::nullopt;
}

// Open MPI 5 begins a line within.
const auto kKilled = testing::ContainsRegex("exited on[ \n]signal 9 \\(Killed\\)");

class Mpi : public TiledObjects {
 protected:
  Mpi() {
    for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"})
      setenv(name, "1", 1);
    // Ranks on one machine have shared memory. Open MPI 5 reports a machine that has no network to standard
    // error.
    setenv("OMPI_MCA_btl", "^tcp", 1);
  }

  Result ranks(int count, std::vector<std::string> arguments, Surroundings surroundings = {}) const {
    arguments.insert(arguments.begin(), {"-k", "5", "120", PCL_BV_MPIEXEC, "--oversubscribe", "-n",
                                         std::to_string(count), PCL_BV_BIN_DIR "/pcd_bv_mpi"});
    surroundings.program = "/usr/bin/timeout";
    return run(arguments, surroundings);
  }

  /// Kills this rank once it has worked a while: it would for a minute and more. The other ranks have ten
  /// seconds instead of one to say that they end: on a busy machine they take longer than one.
  Result ranks_of_which_one_is_killed(int rank, std::vector<std::string> arguments) const {
    setenv("OMPI_MCA_odls_base_sigkill_timeout", "10", 1);
    Surroundings surroundings;
    surroundings.meanwhile = [rank](int launcher) {
      std::optional<int> process;
      for (int i = 0; i < 600 && !process; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        process = process_of_rank(launcher, rank);
      }
      std::this_thread::sleep_for(std::chrono::seconds(2));
      ASSERT_TRUE(process.has_value());
      kill(*process, SIGKILL);
    };
    return ranks(3, std::move(arguments), surroundings);
  }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(at("")), {}));
  }
};

TEST_F(Mpi, HasTheBitsOfOneProcessForEveryMethodAndNumberOfRanks) {
  const std::string folder = tiles("tiles", gaussian(150'000, 1), 20);
  const std::vector<std::string> options{"--together",    "--format", "jsonl",   "--volume",
                                         "all,hull,best", "--check",  "--range", "0.1:1.2",
                                         "--origin",      "auto",     folder};
  const Result expected = run(options);
  ASSERT_EQ(expected.status, 0) << expected.err;
  for (const int count : {1, 2, 3, 4, 8}) {
    const Result result = ranks(count, options);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(result.out == expected.out) << count;
    EXPECT_EQ(result.err, "");
  }
}

TEST_F(Mpi, CutsOneFileIntoRanges) {
  const std::string whole = binary("whole.pcd", gaussian(200'000, 2));
  const Result expected = run({"--together", "--format", "jsonl", "--volume", kServed, whole});
  const Result result = ranks(4, {"--together", "--format", "jsonl", "--volume", kServed, whole});
  EXPECT_TRUE(result.out == expected.out) << result.err;
}

TEST_F(Mpi, OfFewPointsAndOfNoneIsAsOneProcess) {
  for (const std::size_t size : {0UL, 1UL, 700UL, 4200UL}) {
    const std::string folder = tiles("tiles" + std::to_string(size), gaussian(size, 3), 6);
    const std::vector<std::string> options{"--together", "--format", "jsonl", "--volume",
                                           "all,hull",   "--check",  folder};
    const Result result = ranks(3, options);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(result.out == run(options).out) << size;
  }
}

TEST_F(Mpi, FindsTheSmallestSphereInFewRounds) {
  const std::string whole = binary("whole.pcd", gaussian(100'000, 4));
  const Result result = ranks(2, {"--together", "--timings", "--volume", "sphere", whole});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::size_t end = result.err.find(" query rounds");
  ASSERT_NE(end, std::string::npos) << result.err;
  const int rounds = std::stoi(result.err.substr(result.err.rfind(' ', end - 1) + 1));
  EXPECT_GE(rounds, 1);
  EXPECT_LE(rounds, 5);
}

TEST_F(Mpi, LeavesOutAnInputThatFailsOnOneRankAndNamesItOnce) {
  const std::string folder = tiles("tiles", gaussian(60'000, 5), 8);
  const Json expected = run({"--together", "--format", "jsonl", "--volume", "all", folder}).json();
  file("tiles/99.pcd", "no cloud");
  file("tiles/00a.pcd", header(100) + "1 2 3\n1 x 3\n");  // its header is good
  const std::vector<std::string> options{"--together", "--format", "jsonl", "--volume", "all", folder};
  for (const int count : {2, 4}) {
    const Result result = ranks(count, options);
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.json()["clusters"], expected["clusters"]);
    EXPECT_EQ(result.json()["parts"], 8);
    EXPECT_EQ(result.json()["left_out"].size(), 2U);
    for (const char* name : {"tiles/99.pcd: ", "tiles/00a.pcd: "}) {
      EXPECT_THAT(result.err, HasSubstr(name));
      EXPECT_EQ(result.err.find(name), result.err.rfind(name));
    }
  }
  const Result nothing = ranks(2, {"--together", "--format", "jsonl", at("nowhere.pcd")});
  EXPECT_EQ(nothing.status, 1);
  EXPECT_EQ(nothing.json()["error"], "no input could be read");
}

TEST_F(Mpi, DealsOutInputsAndWritesResultsInTheirOrder) {
  const std::string folder = tiles("tiles", gaussian(120'000, 6), 30);
  file("tiles/15a.pcd", "no cloud");
  // Into a file: the mpirun of Open MPI 5.0.7 writes parts of standard output to standard error if a rank
  // uses both.
  const std::vector<std::string> options{"--format", "json",     "--volume",   "all",
                                         "--check",  "--output", at("o.json"), folder};
  ASSERT_EQ(run(options).status, 1);
  const std::string expected = read_file(at("o.json"));
  for (const int count : {1, 2, 5}) {
    std::filesystem::remove(at("o.json"));
    const Result result = ranks(count, options);
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(read_file(at("o.json")) == expected) << count;
    EXPECT_THAT(result.err, HasSubstr("pcd_bv_mpi: " + at("tiles/15a.pcd") + ": "));
    EXPECT_THAT(result.err, HasSubstr("31 files: 30 done, 1 failed, 120000 points"));
  }
  const Result files = ranks(3, {"--mesh", at("meshes"), "--labels", at("labels"), "--output", at("o.json"),
                                 "--format", "json", "--volume", "all", "--cluster", "0.2", folder});
  EXPECT_EQ(files.status, 1);
  EXPECT_TRUE(std::filesystem::exists(at("labels/29.pcd")));
  EXPECT_EQ(Json::parse(read_file(at("o.json"))).size(), 31U);
}

TEST_F(Mpi, SaysWrongUseOnceAndEndsWithStatusTwo) {
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--volume", "cube", "x.pcd"},
        {"--partial", "p", "x.pcd"},
        {},
        {"--together", "--info", "x.pcd"},
        {"--together", "--cluster", "1", "--ground", "plane", "x.pcd"},
        {"--output", at("x.pcd"), at("x.pcd")}}) {
    const Result result = ranks(3, wrong);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("pcd_bv_mpi: "));
    EXPECT_EQ(result.err.find("pcd_bv_mpi: "), result.err.rfind("pcd_bv_mpi: "));
  }
  EXPECT_THAT(ranks(2, {"--version"}).out, testing::StartsWith("pcd_bv_mpi "));
}

TEST_F(Mpi, EndsWithALineAndWritesNothingWhenARankIsKilled) {
  const std::string endless = "synth:surface:3000000";
  for (const int rank : {0, 1}) {
    const Result result = ranks_of_which_one_is_killed(
        rank, {"--together", "--volume", "all", "--check", "--format", "json", "--output", at("o.json"),
               endless, endless, endless, endless, endless, endless, endless, endless});
    EXPECT_NE(result.status, 0);
    EXPECT_NE(result.status, 124) << "it had to be told to end";
    EXPECT_THAT(result.err, kKilled);
    EXPECT_EQ(files(), 0U);
  }
}

TEST_F(Mpi, KeepsWhatIsDoneWhenARankIsKilledAmongManyInputs) {
  std::vector<std::string> arguments{
      "--volume", "all",      "--check",    "--format",
      "json",     "--output", at("o.json"), binary("first.pcd", gaussian(10, 7))};
  arguments.insert(arguments.end(), 40, "synth:surface:3000000");
  const Result result = ranks_of_which_one_is_killed(1, arguments);
  EXPECT_NE(result.status, 0);
  EXPECT_THAT(result.err, kKilled);
  EXPECT_THAT(result.err, HasSubstr("pcd_bv_mpi: interrupted: "));
  if (std::filesystem::exists(at("o.json"))) {
    EXPECT_GE(Json::parse(read_file(at("o.json"))).size(), 1U);
  }
}

TEST_F(Mpi, ObjectsHaveTheBytesOfOneProcess) {
  const std::string folder = tiles("tiles", yard(1), 9);
  std::vector<std::string> options = {"--together", "--format", "jsonl",      "--cluster", "0.4",
                                      "--volume",   "all",      "--min-size", "20",        folder};
  const Result expected = run(options);
  ASSERT_EQ(expected.status, 0) << expected.err;
  for (const int count : {1, 2, 5}) {
    const Result result = ranks(count, options);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(result.out == expected.out) << count << " ranks";
  }
  options.insert(options.end(), {"--labels", at("expected")});
  EXPECT_EQ(run(options).status, 0);
  options.back() = at("labels");
  const Result labelled = ranks(3, options);
  EXPECT_EQ(labelled.status, 0) << labelled.err;
  EXPECT_TRUE(labelled.out == expected.out);
  expect_same_files(at("labels"), at("expected"), 9);
}

TEST_F(Mpi, ObjectsAboveTheGroundHaveTheBytesOfOneProcess) {
  const std::string folder = tiles("tiles", yard(3), 9);
  add_bad_tiles("tiles");
  std::vector<std::string> options = {"--together", "--format", "jsonl", "--cluster",     "0.4",
                                      "--ground",   "slope",    folder,  "--ground-cell", "2"};
  options.insert(options.end(), {"--labels", at("expected")});
  const Result expected = run(options);
  EXPECT_GT(Json::parse(expected.out)["counts"]["ground"], 1000);
  options.back() = at("labels");
  for (const int count : {1, 3}) {
    const Result result = ranks(count, options);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr(folder + "/99.pcd: "));
    EXPECT_THAT(result.err, HasSubstr(folder + "/00a.pcd: "));
    EXPECT_TRUE(result.out == expected.out) << count << " ranks";
    expect_same_files(at("labels"), at("expected"), 9);
  }
}

TEST_F(Mpi, ObjectsAboveTheGroundAreWarnedOfIfAllPointsAreGround) {
  Points flat;
  for (int i = 0; i < 4000; ++i)
    flat.push_back({static_cast<float>(i % 80), static_cast<float>(i / 80), 0});
  const Result result =
      ranks(2, {"--together", "--cluster", "0.5", "--ground", "slope", tiles("flat", flat, 2)});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.error_lines(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("all points were classified as ground (up is z): try --up"));
}

TEST_F(Mpi, ObjectsSayWhatTheyCostOnOneLine) {
  const std::string folder = tiles("tiles", yard(1), 9);
  for (const int count : {1, 3}) {
    const Result result =
        ranks(count, {"--together", "--timings", "--format", "jsonl", "--cluster", "0.4", folder});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_THAT(result.err, HasSubstr(std::to_string(count) + " ranks: "));
    const std::string messages = count == 1 ? ", 0 messages with 0 bytes" : "[1-9][0-9]* messages with [1-9]";
    EXPECT_THAT(result.err, testing::ContainsRegex(" s wall time, [0-9.]+ s CPU time"));
    EXPECT_THAT(result.err, testing::ContainsRegex(messages));
    EXPECT_THAT(result.err, testing::ContainsRegex("maximum memory of a rank [1-9][0-9]* KiB"));
    EXPECT_TRUE(result.json().contains("seconds"));
  }
}

TEST_F(Mpi, ObjectsOfAnInputThatFailsAreLeftOut) {
  const std::string folder = tiles("tiles", yard(1), 8);
  add_bad_tiles("tiles");
  const std::vector<std::string> options = {"--together", "--format", "jsonl",   "--cluster",
                                            "0.4",        folder,     "--labels"};
  const auto with_labels = [&](const std::string& labels) {
    std::vector<std::string> all = options;
    all.push_back(at(labels));
    return all;
  };
  const Result expected = run(with_labels("expected"));
  const Result result = ranks(3, with_labels("labels"));
  expect_same_files(at("labels"), at("expected"), 8);
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(expected.status, 1);
  for (std::size_t at = 0; at < expected.err.size();) {  // each input that failed is named once
    const std::size_t end = expected.err.find('\n', at);
    const std::string problem = expected.err.substr(at + 7, end - at - 7);  // without "pcd_bv:"
    const std::size_t found = result.err.find(problem);
    EXPECT_NE(found, std::string::npos) << problem;
    EXPECT_EQ(result.err.find(problem, found + 1), std::string::npos) << problem;
    at = end + 1;
  }
  EXPECT_TRUE(result.out == expected.out);
}

}  // namespace
}  // namespace pcl_bv::test
