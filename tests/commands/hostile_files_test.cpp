// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files that somebody wrote to do harm, or by mistake: one line, the right status, and nothing left behind.

#include <gmock/gmock.h>

#include <utility>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class HostileFiles : public PcdBv {
 protected:
  // One line that speaks no library's words.
  void expect_refused(const Result& result, int status, const std::string& problem) const {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_THAT(result.err, HasSubstr(problem));
    for (const char* words : {"exception", "yaml-cpp", "std::", "basic_", "bad file", "filesystem error"})
      EXPECT_THAT(result.err, Not(HasSubstr(words)));
  }
  Result drop_inside(const std::string& json) const {
    return run({"--drop-inside", file("f.json", json), "--volume", "aabb", "synth:sphere:100"});
  }
};

TEST_F(HostileFiles, JsonNestedWithoutEndIsALine) {
  const std::string open(20'000, '['), close(20'000, ']');
  expect_refused(drop_inside(R"({"volumes":)" + open + close + "}"), 1, "nested more than 64 deep");
  expect_refused(drop_inside(R"({"volumes":)" + open), 1, "nested more than 64 deep");
  expect_refused(drop_inside("{\"a\": tru}"), 1, "f.json: line 1, column 10: invalid JSON");
}

TEST_F(HostileFiles, AnEntryThatIsNoVolumeIsNamedAndNoPointReturns) {
  const std::string ball = R"({"shape":"sphere","center":[0,0,0],"radius":9})";
  EXPECT_EQ(drop_inside("[" + ball + "]").status, 0);
  const Result result = drop_inside("[" + ball + R"(,{"center":[5,5,5],"radius":1}])");
  expect_refused(result, 1, "f.json: [1]: is no volume: it has no \"shape\"");
  EXPECT_EQ(result.out, "");
  const std::string config = file("c.yaml", "filter: {regions: [{file: '" + at("f.json") + "'}]}");
  expect_refused(run({"--config", config, "synth:sphere:100"}), 1, "f.json: [1]: is no volume");
  expect_refused(run({"--keep-inside", at("f.json"), "synth:sphere:100"}), 1, "f.json: [1]: is no volume");
}

TEST_F(HostileFiles, YamlNestedWithoutEndIsALine) {
  const std::string config = file("c.yaml", "cluster: " + std::string(100'000, '['));
  expect_refused(run({"--config", config, "synth:sphere:100"}), 2, "nested more than 500 deep");
  expect_refused(run({"--config", "/dev/zero", "synth:sphere:100"}), 2, "has more than 1048576 bytes");
}

TEST_F(HostileFiles, ADamagedPartialFileIsOneLine) {
  ASSERT_EQ(run({"--partial", at("part"), "--volume", "aabb", "synth:sphere:100"}).status, 0);
  std::string bytes = read_file(at("part"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  const Result result = run({"--merge", "--volume", "aabb", "--format", "jsonl", file("bad", bytes)});
  expect_refused(result, 1, "bad: is damaged");
  EXPECT_EQ(result.json()["error"], "some partial results cannot be merged");
  expect_refused(run({"--merge", "--partial", at("both"), file("bad", bytes), at("part")}), 1,
                 "bad: is damaged");
  EXPECT_FALSE(std::filesystem::exists(at("both")));
}

TEST_F(HostileFiles, AMessageIsShortWhateverAFileNames) {
  const std::string name(100'000, 'n');
  const std::string tiles =
      R"({"asset":{"version":"1.1"},"root":{"boundingVolume":{"box":[0,0,0,1,0,0,0,1,0,0,0,1]},"content":{"uri":")";
  const Result update = run({"--update", file("t.json", tiles + name + ".b3dm\"}}}")});
  expect_refused(update, 1, "file name too long");
  const Result volume = drop_inside(R"({"shape":")" + name + R"(","center":[0,0,0]})");
  expect_refused(volume, 1, "is no shape");
  Surroundings stream;
  stream.program = "bv_stream";
  const std::string robot =
      "<robot><link name='" + name + "'><collision><geometry/></collision></link></robot>";
  const std::string config =
      file("c.yaml", "rig: {urdf: '" + file("r.urdf", robot) + "', frame: '" + name + "', self_filter: 0.1}");
  const Result link = run({"--config", config, "--source", "synth:street-sequence:1"}, stream);
  EXPECT_NE(link.status, 0);
  for (const Result& result : {update, volume, link})
    for (std::size_t at = 0, end; at < result.err.size(); at = end + 1) {
      end = std::min(result.err.find('\n', at), result.err.size());
      EXPECT_LE(end - at, 500U) << result.err.substr(at, 600);
    }
}

TEST_F(HostileFiles, SinksThatAreOpenedInVainLeaveNothing) {
  const std::string bad = file("plain", "text") + "/under/a.file";
  const std::vector<std::string> bad_sinks{
      "jsonl:" + bad, "csv:" + bad,   "mcap:" + bad,   "rosbag2:" + bad,
      "vtp:" + bad,   "image:" + bad, "labels:" + bad, "ws:no.such.host.invalid:1"};
  std::size_t entries = 0;
  for (const std::string& wrong : bad_sinks) {
    for (const std::string good : {"jsonl", "csv", "mcap", "rosbag2", "vtp", "image", "labels"}) {
      Surroundings stream;
      stream.program = "bv_stream";
      const std::string old = file("old.jsonl", "kept");
      const Result result = run({"--source", "synth:street-sequence:1", "--sink", "jsonl:" + old, "--sink",
                                 good + ":" + at("new"), "--sink", wrong},
                                stream);
      expect_refused(result, 1, wrong.substr(0, wrong.find(':')) + ":");
      EXPECT_FALSE(std::filesystem::exists(at("new"))) << good << " before " << wrong;
      EXPECT_EQ(read_file(old), "kept");
    }
    for (const auto& entry : std::filesystem::directory_iterator(at("")))
      entries += entry.path().filename() != "plain" && entry.path().filename() != "old.jsonl";
  }
  EXPECT_EQ(entries, 0U);
}

TEST_F(HostileFiles, OutputsThatCannotBeWrittenLeaveNothing) {
  const std::string bad = file("plain", "text") + "/under/a";
  for (const std::vector<std::string>& output :
       std::vector<std::vector<std::string>>{{"--output", bad},
                                             {"--labels", bad + ".pcd"},
                                             {"--mesh", bad + ".ply"},
                                             {"--image", bad + ".png"},
                                             {"--view-html", bad + ".html"},
                                             {"--partial", bad}}) {
    std::vector<std::string> arguments{"--volume", "aabb", "synth:sphere:100"};
    arguments.insert(arguments.begin(), output.begin(), output.end());
    expect_refused(run(arguments), 1, "plain/under/a");
    EXPECT_EQ(read_file(at("plain")), "text");
  }
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(at("")))
    ++entries;
  EXPECT_EQ(entries, 1U);
}

TEST_F(HostileFiles, NumbersOfOptionsAreRefusedWithValueAndRange) {
  const std::vector<std::pair<std::string, std::string>> options{
      {"--sensor-height", "finite"},  {"--ground-distance", "above 0"}, {"--ground-slope", "at most 89"},
      {"--min-size", "whole number"}, {"--max-size", "of at least 1"},  {"--min-points", "of at least 1"},
      {"--threads", "at most 1024"}};
  for (const auto& [option, range] : options) {
    for (const std::string value : {"-1", "nan", "inf", "1e+300"}) {
      const bool allowed =
          value == "1e+300" && (option == "--sensor-height" || option == "--ground-distance");
      if (allowed) continue;
      const Result result = run({"--ground", "plane", "--cluster", "1", option + "=" + value, "--volume",
                                 "aabb", "synth:sphere:100"});
      EXPECT_EQ(result.status, 2) << option << ' ' << value;
      EXPECT_EQ(result.error_lines(), 1U) << result.err;
      EXPECT_THAT(result.err, HasSubstr(option + ": ")) << value;
      EXPECT_THAT(result.err, HasSubstr(value)) << option;
      EXPECT_THAT(result.err, HasSubstr(range)) << option << ' ' << value;
    }
  }
  expect_refused(
      run({"--cluster", "1e-300", "synth:sphere:100"}), 2,
      "--cluster TOL: 1e-300 is too small: it becomes 0 as float32, the type of points; use 0, or at "
      "least 1.4e-45");
  expect_refused(run({"--cluster", "-1", "synth:sphere:100"}), 2,
                 "--cluster TOL: -1 is not at least 0 and at most 1e+06");
}

}  // namespace
}  // namespace pcl_bv::test
