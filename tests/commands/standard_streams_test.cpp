// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Standard output and standard error of both commands, whatever the caller has made of them.

#include <gmock/gmock.h>
#include <unistd.h>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class StandardStreams : public PcdBv, public testing::WithParamInterface<std::string> {
 protected:
  Result ask(const std::string& argument, Surroundings surroundings = {}) const {
    surroundings.program = GetParam();
    return run({argument}, surroundings);
  }

  /// A run that makes results.
  Result work(const std::string& cloud, Surroundings surroundings = {}) const {
    surroundings.program = GetParam();
    if (GetParam() == "pcd_bv") return run({cloud}, surroundings);
    return run({"--source", cloud, "--rate", "max"}, surroundings);
  }
};

TEST_P(StandardStreams, TextsEndQuietlyWhenNobodyReads) {
  for (const std::string text : {"--help", "--version", "--print-config"}) {
    if (text == "--print-config" && GetParam() != "bv_stream") continue;
    const Result result = ask(text, {.nobody_reads = true});
    EXPECT_EQ(result.status, 0) << text;
    EXPECT_EQ(result.err, "") << text;
  }
}

TEST_P(StandardStreams, AFullDiskUnderATextIsStatusOne) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const std::string text : {"--help", "--version"}) {
    const Result result = ask(text, {.output = "/dev/full"});
    EXPECT_EQ(result.status, 1) << text;
    EXPECT_EQ(result.err, GetParam() + ": standard output: no space left on device\n");
  }
}

TEST_P(StandardStreams, ResultsForAClosedStandardOutputAreLostWithStatusOne) {
  const Result result = work(ascii("a.pcd", {"1 2 3"}), {.closed = {STDOUT_FILENO}});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, GetParam() + ": standard output: bad file descriptor\n");
}

TEST_P(StandardStreams, AClosedStandardErrorReceivesNothingAndHarmsNoFile) {
  const std::string good = ascii("a.pcd", {"1 2 3"});
  file("bad.pcd", "no cloud");
  Surroundings surroundings{.program = GetParam(), .closed = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}};
  const Result result =
      GetParam() == "pcd_bv"
          ? run({"--output", at("out"), at("missing.pcd"), good, at("bad.pcd")}, surroundings)
          : run({"--source", at("."), "--rate", "max", "--sink", "jsonl:" + at("out")}, surroundings);
  EXPECT_EQ(result.status, GetParam() == "pcd_bv" ? 1 : 0);
  EXPECT_THAT(read_file(at("out")), HasSubstr("a"));
  EXPECT_THAT(read_file(at("out")), testing::Not(HasSubstr(GetParam() + ": ")));
}

TEST_P(StandardStreams, AComplaintIsOneLineThatSteersNoTerminal) {
  const Result result = work(at("two\nlines\x1b[31m\x7f.pcd"));
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.error_lines(), 1U) << result.err;
  EXPECT_THAT(result.err, StartsWith(GetParam() + ": "));
  EXPECT_THAT(result.err, HasSubstr("two?lines?[31m?.pcd: "));
}

TEST_P(StandardStreams, WrongUseIsAComplaintToo) {
  const Result result = ask("--vol\name");
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.error_lines(), 1U) << result.err;
  EXPECT_THAT(result.err, StartsWith(GetParam() + ": "));
  EXPECT_THAT(result.err, HasSubstr("; " + GetParam() + " --help lists the options\n"));
}

TEST_P(StandardStreams, HelpFitsAHundredColumnsAndHasExamples) {
  const std::string help = ask("--help").out;
  EXPECT_THAT(help, HasSubstr("Examples:\n  " + GetParam() + " "));
  EXPECT_THAT(help, HasSubstr("Exit status: 0 "));
  for (std::size_t begin = 0, end; (end = help.find('\n', begin)) != std::string::npos; begin = end + 1)
    EXPECT_LE(end - begin, 100U) << help.substr(begin, end - begin);
}

INSTANTIATE_TEST_SUITE_P(EveryCommand, StandardStreams, testing::Values("pcd_bv", "bv_stream"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace pcl_bv::test
