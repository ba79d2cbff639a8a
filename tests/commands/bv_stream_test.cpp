// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command bv_stream as its users run it.

#include <gmock/gmock.h>

#include <cstdint>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class BvStream : public PcdBv {
 protected:
  Result stream(std::vector<std::string> arguments, Surroundings surroundings = {}) const {
    surroundings.program = "bv_stream";
    return run(std::move(arguments), surroundings);
  }

  // Through a program that takes the command as its own arguments.
  Result stream_under(std::vector<std::string> wrapper, std::vector<std::string> arguments) const {
    Surroundings surroundings;
    surroundings.program = wrapper.front();
    wrapper.erase(wrapper.begin());
    wrapper.push_back(PCL_BV_BIN_DIR "/bv_stream");
    wrapper.insert(wrapper.end(), arguments.begin(), arguments.end());
    return run(wrapper, surroundings);
  }

  // In the test's folder: the command runs in the background as $!, `then` is what follows it.
  Result stream_in_shell(const std::string& then, const std::vector<std::string>& arguments,
                         const std::string& before = "") const {
    // Of what is in the background a shell ignores SIGINT.
    const std::string command =
        "cd '" + at("") + "'; " + before + "env --default-signal=INT \"$@\" & " + then;
    return stream_under({"/bin/sh", "-c", command, "sh"}, arguments);
  }

  std::string synth(const std::string& name) const {
    Surroundings surroundings;
    surroundings.program = "synth";
    EXPECT_EQ(run({name, at("clouds")}, surroundings).status, 0);
    return at("clouds");
  }
};

std::vector<Json> lines(const std::string& text) {
  std::vector<Json> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    all.push_back(Json::parse(line));
  return all;
}

// All but the times, which differ from run to run.
std::vector<Json> results(const std::string& text) {
  std::vector<Json> all = lines(text);
  for (Json& line : all)
    line.erase("ms");
  return all;
}

TEST_F(BvStream, WritesALinePerFrameWithTheDocumentedKeys) {
  const Result result =
      stream({"--source", "synth:street-sequence:3", "--rate", "max", "--track", "--volume", "aabb,dop14"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::vector<Json> frames = lines(result.out);
  ASSERT_EQ(frames.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : frames[i].items())
      keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"schema", "seq", "stamp_ns", "frame_id", "points", "counts",
                                              "clusters", "ms"}));
    EXPECT_EQ(frames[i]["seq"], i);
    EXPECT_EQ(frames[i]["stamp_ns"], 100'000'000 * i);
    EXPECT_EQ(frames[i]["points"], 128'000);
    const Json& first = frames[i]["clusters"][0];
    EXPECT_EQ(first["id"], 0);
    EXPECT_EQ(first["track"].is_null(), i < 2);
    for (const char* key : {"age", "velocity", "moving", "pose", "covariance"})
      EXPECT_EQ(first.contains(key), i == 2) << key;
    EXPECT_EQ(first["volumes"][1]["method"], "dop14");
    for (const char* stage : {"decode", "filter", "ground", "cluster", "fit", "track", "total"})
      EXPECT_TRUE(frames[i]["ms"][stage].is_number()) << stage;
  }
}

TEST_F(BvStream, ReadsTheRuralRoadMadeOrFromItsFolderWithPosesAlike) {
  const std::string folder = synth("rural-road-sequence-16:2:3");
  const std::vector<std::string> common = {"--rate", "max",        "--track", "--volume",
                                           "aabb",   "--frame-id", "road"};
  const auto with = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), common.begin(), common.end());
    return stream(arguments);
  };
  const Result made = with({"--source", "synth:rural-road-sequence-16:2:3"});
  const Result read = with({"--source", folder, "--poses", folder + "/poses.txt"});
  ASSERT_EQ(made.status, 0) << made.err;
  ASSERT_EQ(read.status, 0) << read.err;
  std::vector<Json> expected = results(made.out), found = results(read.out);
  ASSERT_EQ(expected.size(), 2U);
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_GT(expected[i]["clusters"].size(), 0U);
    EXPECT_EQ(found[i]["clusters"], expected[i]["clusters"]);
    EXPECT_EQ(found[i]["counts"], expected[i]["counts"]);
  }
  const Result refused = with({"--source", "synth:rural-road-sequence-17"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("[-16|-32|-64|-128]"), std::string::npos) << refused.err;
}

TEST_F(BvStream, ReadsItsOwnRecordingToTheSameClusters) {
  const std::string file = at("out.mcap");
  const Result made = stream({"--source", "synth:street-sequence:4", "--rate", "max", "--track", "--sink",
                              "mcap:" + file + ",points", "--sink", "jsonl:-"});
  ASSERT_EQ(made.status, 0) << made.err;
  const Result read = stream({"--source", file, "--rate", "max", "--track"});
  ASSERT_EQ(read.status, 0) << read.err;
  const std::vector<Json> expected = results(made.out), found = results(read.out);
  ASSERT_EQ(expected.size(), 4U);
  ASSERT_EQ(found.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    for (const char* key : {"seq", "stamp_ns", "frame_id", "points", "counts", "clusters"})
      EXPECT_EQ(found[i][key], expected[i][key]) << key;
  }
  const Result topic = stream({"--source", file, "--topic", "/bv/scene"});
  EXPECT_EQ(topic.status, 2);
  EXPECT_EQ(topic.err,
            "bv_stream: --source: topic /bv/scene is of foxglove_msgs/msg/SceneUpdate (cdr), not of "
            "clouds; those with clouds: /bv/points\n");
  const Result clouds = run({"--format", "jsonl", "--volume", "aabb", file});
  ASSERT_EQ(clouds.status, 0) << clouds.err;
  const std::vector<Json> inputs = results(clouds.out);
  ASSERT_EQ(inputs.size(), 4U);
  EXPECT_EQ(inputs[3]["file"], file + "#3");
  EXPECT_EQ(inputs[3]["points"], expected[3]["points"]);
  const Result useless = stream({"--source", "synth:street-sequence:1", "--topic", "/points"});
  EXPECT_EQ(useless.status, 2);
  EXPECT_EQ(useless.err, "bv_stream: --topic: only useful with a recording\n");
  const Result same = stream({"--source", file, "--sink", "mcap:" + file});
  EXPECT_EQ(same.status, 2) << same.err;
}

TEST_F(BvStream, GivesTheSameForEveryNumberOfThreadsOnOneProcessorAndAgain) {
  const std::vector<std::string> common = {"--source", "synth:street-sequence:2", "--rate", "max", "--track"};
  const auto with = [&](const char* threads) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), {"--threads", threads});
    return arguments;
  };
  const std::vector<Json> expected = results(stream(common).out);
  ASSERT_EQ(expected.size(), 2U);
  EXPECT_EQ(results(stream(common).out), expected);
  for (const char* threads : {"0", "2", "3"})
    EXPECT_EQ(results(stream(with(threads)).out), expected) << threads;
  EXPECT_EQ(results(stream_under({"/usr/bin/taskset", "-c", "0"}, with("2")).out), expected);
}

TEST_F(BvStream, AFrameThatCannotBeReadIsALineAndTheStreamGoesOn) {
  ascii("sweeps/1.pcd", {"1 2 3"});
  const std::string bad = file("sweeps/2.pcd", "no cloud at all");
  ascii("sweeps/3.pcd", {"1 2 3"});
  const std::string stats = at("stats.json");
  const Result result = stream({"--source", at("sweeps"), "--rate", "max", "--stats", stats});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.error_lines(), 1U);
  EXPECT_THAT(result.err, testing::StartsWith("bv_stream: " + bad + ": frame 1: "));
  const std::vector<Json> frames = lines(result.out);
  ASSERT_EQ(frames.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(frames[i]["seq"], i);
    EXPECT_EQ(frames[i].contains("error"), i == 1);
  }
  EXPECT_EQ(frames[1]["file"], bad);
  const Json totals = Json::parse(read_file(stats))["frames"];
  EXPECT_EQ(totals["in"], 3);
  EXPECT_EQ(totals["processed"], 2);
  EXPECT_EQ(totals["dropped"]["error"], 1);
}

TEST_F(BvStream, WithoutAReadableSourceFails) {
  EXPECT_EQ(stream({"--source", at("missing")}).status, 1);
  file("empty/readme.txt", "");
  EXPECT_EQ(stream({"--source", at("empty")}).status, 1);
  file("bad/1.pcd", "no cloud");
  const Result result = stream({"--source", at("bad"), "--rate", "max"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.error_lines(), 1U);
}

TEST_F(BvStream, ABadConfigurationNamesItsLine) {
  const std::string config = file("robot.yaml", "cluster:\n  tolerance: -1\n");
  const Result result = stream({"--config", config, "--source", "synth:street-sequence:1"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err,
            "bv_stream: " + config + ": line 2: cluster.tolerance: -1 is not at least 0 and at most 1e+06\n");
}

TEST_F(BvStream, OptionsOverrideTheFileAndThePrintedOneReadsBack) {
  const std::string config =
      file("robot.yaml", "cluster: {tolerance: 0.3, min_size: 5}\nrunner: {queue: 4}\n");
  const Result printed = stream({"--config", config, "--cluster", "0.7", "--print-config"});
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_THAT(printed.out, HasSubstr("tolerance: 0.7"));
  EXPECT_THAT(printed.out, HasSubstr("min_size: 5"));
  EXPECT_THAT(printed.out, HasSubstr("queue: 4"));
  const std::string again = file("again.yaml", printed.out);
  EXPECT_EQ(stream({"--config", again, "--print-config"}).out, printed.out);
}

TEST_F(BvStream, WrongUseIsOneLineAndStatusTwo) {
  const std::string source = "synth:street-sequence:1";
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {},
           {"--source"},
           {"--source", source, "--frobnicate"},
           {"--source", source, "--rate", "0"},
           {"--source", source, "--rate", "fast"},
           {"--source", source, "--rate", "1e-300"},
           {"--source", source, "--stamps", "name"},
           {"--source", source, "--sink", "jsonl:" + at("same"), "--sink", "csv:" + at("same")},
           {"--source", source, "--sink", "jsonl:-", "--sink", "csv:-"},
           {"--source", source, "--sink", "jsonl:" + at("same"), "--stats", at("same")},
           {"--source", source, "--loop", "0"},
           {"--source", source, "--stamps", "clock"},
           {"--source", source, "--volume", "boxes"},
           {"--source", source, "--range", "5"},
           {"--source", source, "--range", "5:1"},
           {"--source", source, "--ground", "mud"},
           {"--source", source, "--up", "w"},
           {"--source", source, "--sensor-height", "-1"},
           {"--source", source, "--cluster", "nan"},
           {"--source", source, "--min-size", "9", "--max-size", "3"},
           {"--source", source, "--policy", "panic"},
           {"--source", source, "--queue", "0"},
           {"--source", source, "--isa", "mmx"},
           {"--source", source, "--sink", "xml:a"},
           {"--source", source, "--sink", "csv:"},
           {"--source", source, "--sink", "vtp:,points"},
           {"--source", source, "--sink", "vtp:" + at("v"), "--sink", "vtp:" + at("v") + ",points"},
           {"--source", source, "--report", "0"},
           {"--source", source, "--report", "nan"},
           {"--source", source, "--poses", ""},
           {"--source", "synth:nothing"},
           {"--source", source, "--config", at("missing.yaml")}}) {
    const Result result = stream(arguments);
    EXPECT_EQ(result.status, 2) << testing::PrintToString(arguments);
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

TEST_F(BvStream, WritesCsvAndMeshesThatParaViewPlays) {
  const std::string csv = at("objects.csv"), folder = at("meshes");
  const Result result = stream({"--source", "synth:street-sequence:2", "--rate", "max", "--volume", "aabb",
                                "--sink", "csv:" + csv, "--sink", "vtp:" + folder});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "");
  const std::string text = read_file(csv);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "seq,stamp_ns,track,cluster,points,method,cx,cy,cz,sx,sy,sz,qx,qy,qz,qw,radius,volume,"
            "vx,vy,vz,x,y,z,yaw,length,width,height,box_yaw");
  EXPECT_THAT(text, HasSubstr(",,,,,,,,,,,\n1,100000000")) << "no track, no upright box";
  EXPECT_THAT(text, HasSubstr("\n0,0,,0,"));
  EXPECT_THAT(text, HasSubstr("\n1,100000000,,0,"));
  EXPECT_EQ(text.back(), '\n');
  EXPECT_THAT(read_file(folder + "/frame000001.vtp"), HasSubstr("PolyData"));
  EXPECT_THAT(read_file(folder + "/frames.pvd"), HasSubstr("frame000001.vtp"));
}

TEST_F(BvStream, SaysInALineWhichOptionHasNoEffect) {
  const std::vector<std::string> some = {"--source", "synth:street-sequence:1", "--rate", "max"};
  const auto said = [&](std::vector<std::string> options) {
    options.insert(options.begin(), some.begin(), some.end());
    const Result result = stream(options);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  };
  EXPECT_EQ(said({"--track", "--grow", "--volume", "obb,aabb"}),
            "bv_stream: --grow: has no effect without an upright box, obb-yaw or obb-lshape\n");
  EXPECT_EQ(said({"--smooth"}), "bv_stream: --smooth: has no effect without --track\n");
  EXPECT_EQ(said({"--oversized", "keep"}), "bv_stream: --oversized: has no effect without --max-size\n");
  EXPECT_EQ(said({"--track", "--grow", "--smooth"}), "");
}

TEST_F(BvStream, CreatesTheFoldersThatSinksNameAndNoOthers) {
  const std::vector<std::string> some{"--source", "synth:street-sequence:1", "--rate", "max", "--volume",
                                      "aabb"};
  std::vector<std::string> good = some;
  for (const char* sink : {"vtp", "image", "labels", "rosbag2"})
    good.insert(good.end(), {"--sink", std::string(sink) + ":" + at(sink)});
  const Result result = stream(good);
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* name :
       {"vtp/frames.pvd", "image/frame000000.png", "labels/frame000000.pcd", "rosbag2/metadata.yaml"})
    EXPECT_NE(read_file(at(name)), "") << name;
  for (const char* sink : {"csv", "jsonl", "kitti", "mcap", "vtp", "image", "labels", "rosbag2"}) {
    std::vector<std::string> bad = some;
    bad.insert(bad.end(), {"--sink", std::string(sink) + ":" + at("no/x")});
    EXPECT_EQ(stream(bad).status, 1) << sink;
    EXPECT_FALSE(std::filesystem::exists(at("no"))) << sink;
  }
  std::vector<std::string> stats = some;
  stats.insert(stats.end(), {"--stats", at("no/x")});
  EXPECT_EQ(stream(stats).err, "bv_stream: " + at("no/x") + ": its folder does not exist\n");
}

TEST_F(BvStream, RefusesOptionsThatItsSourceDoesNotUse) {
  const std::string cloud =
                        file("a.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n"),
                    synth = "synth:street-sequence:1";
  for (const auto& [arguments, what] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--source", cloud, "--topic", "/points"}, "--topic: only useful with a recording"},
           {{"--source", synth, "--topic", "/points"}, "--topic: only useful with a recording"},
           {{"--source", cloud, "--bin-fields", "5"}, "--bin-fields: only useful with .bin files"},
           {{"--source", at(""), "--bin-fields", "5"}, "--bin-fields: only useful with .bin files"},
           {{"--source", synth, "--bin-fields", "5"}, "--bin-fields: only useful with .bin files"},
           {{"--source", synth, "--stamps", "name"}, "--stamps name: only useful with files"},
           {{"--source", cloud, "--sync", "9"}, "--sync: only useful with --target-frame"}}) {
    const Result result = stream(arguments);
    EXPECT_EQ(result.status, 2) << what;
    EXPECT_THAT(result.err, HasSubstr("bv_stream: " + what));
  }
  file("b.bin", std::string(16, '\0'));
  EXPECT_EQ(stream({"--source", at(""), "--bin-fields", "4", "--rate", "max"}).status, 0);
}

TEST_F(BvStream, ASignalLetsTheQueueBeDoneAndWritesTheStatistics) {
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    const std::string stats = at(std::string(signal) + ".json");
    const Result result = stream_in_shell(
        "while ! [ -s seen ]; do sleep 0.05; done; kill -" + std::string(signal) + " $!; wait $!",
        {"--source", "synth:street-sequence:5", "--loop", "1000", "--rate", "20", "--volume", "aabb",
         "--sink", "jsonl:" + at("seen"), "--stats", stats});
    EXPECT_EQ(result.status, 0) << signal << result.err;
    const Json totals = Json::parse(read_file(stats))["frames"];
    const int dropped = totals["dropped"]["queue"].get<int>() + totals["dropped"]["age"].get<int>() +
                        totals["dropped"]["error"].get<int>();
    EXPECT_GE(totals["processed"].get<int>(), 1);
    EXPECT_EQ(totals["in"].get<int>(), totals["processed"].get<int>() + dropped);
    EXPECT_EQ(lines(read_file(at("seen"))).size(), totals["in"].get<std::size_t>());
    std::filesystem::remove(at("seen"));
  }
}

TEST_F(BvStream, ASignalIsHeededWhileNothingComes) {
  ascii("sweeps/1.pcd", {"1 2 3"});
  const Result result = stream_in_shell(
      "while ! [ -s seen ]; do sleep 0.05; done; kill -INT $!; wait $!",
      {"--source", at("sweeps"), "--loop", "9", "--rate", "0.001", "--sink", "jsonl:" + at("seen")});
  EXPECT_EQ(result.status, 0) << result.err;  // the second frame would be due in 17 minutes
  EXPECT_EQ(lines(read_file(at("seen"))).size(), 1U);
}

TEST_F(BvStream, ASignalThatItsCallerIgnoresIsNotHeeded) {
  ascii("sweeps/1.pcd", {"1 2 3"});
  const Result result = stream_under(
      {"/bin/sh", "-c",
       "cd '" + at("") +
           "'; trap '' INT; \"$@\" & while ! [ -s seen ]; do sleep 0.05; done; kill -INT $!; "
           "sleep 0.3; kill -0 $! || exit 99; kill -TERM $!; wait $!",
       "sh"},
      {"--source", at("sweeps"), "--loop", "9", "--rate", "0.001", "--sink", "jsonl:" + at("seen")});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(BvStream, OutputsReplaceNothingThatIsRead) {
  const std::string sweeps = at("sweeps");
  ascii("sweeps/1.pcd", {"1 2 3", "2 3 4"});
  for (const char* file : {"run.yaml", "robot.json", "poses.txt"})
    std::ofstream(at(file)) << (file == std::string("run.yaml") ? "threads: 1\n"
                                                                : "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const std::vector<std::string> all{"--source",      sweeps,           "--config", at("run.yaml"),
                                     "--drop-inside", at("robot.json"), "--poses",  at("poses.txt")};
  for (const std::string& read : {at("run.yaml"), at("robot.json"), at("poses.txt"), sweeps + "/1.pcd"}) {
    const std::string before = read_file(read);
    for (const std::string& output : {"--stats " + read, "--sink csv:" + read, "--sink jsonl:" + read}) {
      std::vector<std::string> arguments = all;
      arguments.push_back(output.substr(0, output.find(' ')));
      arguments.push_back(output.substr(output.find(' ') + 1));
      const Result result = stream(arguments);
      EXPECT_EQ(result.status, 2) << output;
      EXPECT_THAT(result.err, HasSubstr("is an input and would be overwritten"));
      EXPECT_EQ(read_file(read), before);
    }
  }
}

TEST_F(BvStream, SaysWhichSubfoldersAreNotRead) {
  ascii("sweeps/1.pcd", {"1 2 3"});
  std::filesystem::create_directory(at("sweeps/more"));
  const Result result = stream({"--source", at("sweeps"), "--rate", "max"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "bv_stream: " + at("sweeps") + ": 1 subfolder is not read\n");
}

TEST_F(BvStream, ASecondSignalEndsItAtOnce) {
  const Result result = stream_in_shell(
      "while ! [ -s seen ]; do sleep 0.05; done; sleep 0.3; kill -HUP $!; sleep 0.3; kill -0 $! || exit 99; "
      "kill -INT $!; wait $!; status=$?; kill $reader; exit $status",
      {"--source", "synth:street-sequence:5", "--loop", "1000", "--rate", "max", "--sink",
       "jsonl:" + at("seen"), "--sink", "jsonl:" + at("full")},
      "mkfifo full; sleep 600 < full & reader=$!; ");  // who never reads
  EXPECT_EQ(result.status, 130) << result.err;
}

TEST_F(BvStream, APipeIsNoSourceAndNotWaitedFor) {
  const Result result =
      stream_in_shell("wait $!", {"--source", at("pipe"), "--rate", "max"}, "mkfifo pipe; ");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("pipe: frame 0: "));
}

TEST_F(BvStream, DroppedFramesAreSaidAndHaveTheirLines) {
  ascii("sweeps/1.pcd", {"1 2 3"});
  const std::string stats = at("stats.json"), folder = at("pictures");  // slow
  const Result result =
      stream({"--source", at("sweeps"), "--loop", "40", "--rate", "1000000", "--sink", "jsonl:-", "--sink",
              "csv:" + at("a.csv"), "--sink", "image:" + folder, "--stats", stats});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json totals = Json::parse(read_file(stats))["frames"];
  const std::string dropped = std::to_string(totals["dropped"]["queue"].get<int>());
  ASSERT_NE(dropped, "0");
  EXPECT_EQ(result.err, "bv_stream: dropped " + dropped + " of 40 frames: " + dropped + " queue, 0 age\n");
  const std::vector<Json> frames = lines(result.out);
  ASSERT_EQ(frames.size(), 40U);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(frames[i]["seq"], i);
    EXPECT_EQ(frames[i]["file"], at("sweeps") + "/1.pcd");
    lost += frames[i].contains("error");
    if (!frames[i].contains("error")) continue;
    EXPECT_EQ(frames[i]["error"], "dropped: queue");
    EXPECT_THAT(read_file(at("a.csv")), HasSubstr("\n" + std::to_string(i) + ","));
  }
  EXPECT_EQ(std::to_string(lost), dropped);
  EXPECT_GT(Json::parse(read_file(stats))["ms"]["sinks"]["image:" + folder]["p50"], 0);
}

TEST_F(BvStream, AnIndexIsWholeWheneverItIsCutOff) {
  const Result result = stream_in_shell(
      "while ! [ -f v/frame000003.vtp ]; do sleep 0.02; done; kill -KILL $!; wait $!; "
      "exec python3 -c 'import glob, xml.etree.ElementTree as tree\n"
      "names = [e.get(\"file\") for e in tree.parse(\"v/frames.pvd\").iter(\"DataSet\")]\n"
      "assert len(names) >= 6, names\n"
      "for name in names: assert tree.parse(\"v/\" + name).getroot().get(\"type\") == \"PolyData\"\n'",
      {"--source", "synth:street-sequence:5", "--loop", "1000", "--rate", "max", "--volume", "aabb", "--sink",
       "vtp:" + at("v") + ",points"});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(BvStream, PosesOfAnotherLengthFailAndFramesWithoutAPoseAreSaid) {
  ascii("sweeps/a.pcd", {"1 2 3"});
  const std::string kitti = file("kitti.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n");
  const Result wrong = stream({"--source", at("sweeps"), "--rate", "max", "--poses", kitti});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_EQ(wrong.err, "bv_stream: " + kitti + ": 2 poses of 1 frames\n");
  EXPECT_EQ(stream({"--source", at("sweeps"), "--poses", at("none")}).status, 1);
  const std::string tum = file("tum.txt", "0 0 0 0 0 0 0 1\n0.1 0 0 0 0 0 0 1\n");
  for (const char* name : {"b", "c", "d", "e"})
    ascii("sweeps/" + std::string(name) + ".pcd", {"1 2 3"});
  const Result some = stream({"--source", at("sweeps"), "--rate", "max", "--poses", tum});
  EXPECT_EQ(some.status, 0);
  EXPECT_EQ(some.err, "bv_stream: 3 of 5 frames have no pose\n");  // rate max: stamps of 10 Hz
}

TEST_F(BvStream, PacesByJitteringStampsAndThoseThatGoBack) {
  const std::vector<std::int64_t> stamps = {1'317'384'506'400'000'000, 1'317'384'506'400'000'001,
                                            1'317'384'506'430'000'000, 1'317'384'506'431'000'000};
  for (const std::int64_t stamp : stamps)
    ascii("sweeps/" + std::to_string(stamp) + ".pcd", {"1 2 3"});
  const Result result = stream({"--source", at("sweeps"), "--rate", "recorded", "--loop", "2", "--policy",
                                "block", "--report", "0.02", "--frame-id", "velodyne"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("bv_stream: "));
  EXPECT_THAT(result.err, HasSubstr(" done, dropped 0 queue, 0 age, 0 error; latency p50 "));
  const std::vector<Json> frames = lines(result.out);
  ASSERT_EQ(frames.size(), 8U);
  const std::int64_t later = 41'333'333;  // a mean step after the last stamp of the first pass
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(frames[i]["stamp_ns"], stamps[i % 4] + (i < 4 ? 0 : later));
    EXPECT_EQ(frames[i]["frame_id"], "velodyne");
  }
}

TEST_F(BvStream, FrameNumbersAreNotTakenForTimes) {
  ascii("sweeps/000000.pcd", {"1 2 3"});
  const Result result = stream({"--source", at("sweeps"), "--stamps", "name"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("000000.pcd: no file name has a time"));
  EXPECT_EQ(stream({"--source", at("sweeps"), "--rate", "recorded"}).status, 2);
}

TEST_F(BvStream, AReaderThatGoesAwayEndsItQuietly) {
  Surroundings surroundings;
  surroundings.nobody_reads = true;
  for (const char* sink : {"jsonl:-", "csv:-"}) {
    const Result result =
        stream({"--source", "synth:street-sequence:3", "--loop", "1000", "--rate", "max", "--sink", sink},
               surroundings);
    EXPECT_EQ(result.status, 0) << sink;
    EXPECT_EQ(result.err, "") << sink;
  }
  const Result stats = stream({"--source", "synth:street-sequence:1", "--loop", "1000", "--rate", "max",
                               "--stats", "/proc/nonexistent/s.json"},
                              surroundings);
  EXPECT_EQ(stats.status, 1);
  EXPECT_EQ(stats.error_lines(), 1U);
}

TEST_F(BvStream, NeverWritesOverWhatItReads) {
  const std::string first = ascii("sweeps/1.pcd", {"1 2 3"}), config = file("c.yaml", "threads: 1\n");
  const std::string before = read_file(first);
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"--source", first, "--sink", "csv:" + first},
           {"--source", at("sweeps"), "--stats", first},
           {"--source", at("sweeps"), "--sink", "jsonl:" + at("sweeps/../sweeps/1.pcd")},
           {"--source", at("sweeps"), "--sink", "labels:" + at("sweeps")},
           {"--source", at("sweeps"), "--poses", config, "--stats", config},
           {"--source", at("sweeps"), "--config", config, "--stats", config}}) {
    EXPECT_EQ(stream(arguments).status, 2) << testing::PrintToString(arguments);
    EXPECT_EQ(read_file(first), before);
  }
  const std::string kept = file("kept", "precious");
  EXPECT_EQ(stream({"--source", first, "--sink", "jsonl:" + kept, "--sink", "foo:bar"}).status, 2);
  EXPECT_EQ(read_file(kept), "precious");
}

TEST_F(BvStream, AsFastAsPossibleLosesNothingAlsoWithAConfiguration) {
  const std::string config = file("c.yaml", "cluster: {tolerance: 0.4}\n"), stats = at("stats.json");
  ascii("sweeps/1.pcd", {"1 2 3"});
  ASSERT_EQ(stream({"--source", at("sweeps"), "--loop", "200", "--rate", "max", "--config", config, "--stats",
                    stats})
                .status,
            0);
  EXPECT_EQ(Json::parse(read_file(stats))["frames"]["processed"], 200);
  const std::string printed = file("printed.yaml", stream({"--print-config"}).out);
  EXPECT_THAT(read_file(printed), HasSubstr("policy: auto"));
  const Result again = stream(
      {"--source", at("sweeps"), "--loop", "200", "--rate", "max", "--config", printed, "--stats", stats});
  EXPECT_EQ(again.err, "");
  EXPECT_EQ(Json::parse(read_file(stats))["frames"]["processed"], 200);
}

TEST_F(BvStream, ATerminalShowsTheFrameBelowTheProblemsAndASummaryInTheEnd) {
  if (!has_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  ascii("sweeps/1.pcd", {"1 2 3"});
  file("sweeps/2.pcd", "no cloud");
  ascii("sweeps/3.pcd", {"1 2 3"});
  const Result result = stream({"--source", at("sweeps"), "--rate", "max"}, {.terminal = true});
  EXPECT_EQ(result.status, 0);
  const std::string erased = "\r" + std::string(std::string("frame 0: 0 objects, 0.0 ms").size(), ' ') + "\r";
  EXPECT_THAT(result.err, testing::StartsWith("frame 0: 0 objects, "));
  EXPECT_THAT(result.err, HasSubstr(" ms" + erased + "bv_stream: " + at("sweeps/2.pcd") + ": frame 1: "));
  EXPECT_THAT(
      result.err,
      HasSubstr(erased + "bv_stream: 3 frames, 2 done, dropped 0 queue, 0 age, 1 error; latency p50 "));
}

TEST_F(BvStream, AllMeansEveryMethodButTheHull) {
  const std::string cloud = ascii("1.pcd", {"1 2 3", "1.1 2 3", "1 2.1 3", "1 2 3.1", "1.1 2.1 3.2"});
  const Result result =
      stream({"--source", cloud, "--rate", "max", "--ground", "none", "--min-size", "1", "--volume", "all"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("obb-lshape"));
  EXPECT_THAT(result.out, HasSubstr("ellipsoid"));
  EXPECT_THAT(result.out, Not(HasSubstr("\"hull\"")));
}

TEST_F(BvStream, AnOutputThatCannotBeWrittenFails) {
  const std::vector<std::string> source = {"--source", "synth:street-sequence:1", "--rate", "max"};
  for (const std::vector<std::string>& output :
       std::vector<std::vector<std::string>>{{"--sink", "jsonl:/proc/nonexistent/a"},
                                             {"--sink", "vtp:/proc/a"},
                                             {"--stats", "/proc/nonexistent/a"},
                                             {"--sink", "jsonl:/dev/full"}}) {
    std::vector<std::string> arguments = source;
    arguments.insert(arguments.end(), output.begin(), output.end());
    const Result result = stream(arguments);
    EXPECT_EQ(result.status, 1) << output[1];
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
  }
}

TEST_F(BvStream, ReadsRecordedFramesAndTheirStamps) {
  const std::string folder = synth("street-sequence:2");
  const Result recorded = stream({"--source", folder, "--rate", "max", "--volume", "aabb"});
  const Result made = stream({"--source", "synth:street-sequence:2", "--rate", "max", "--volume", "aabb"});
  ASSERT_EQ(recorded.status, 0) << recorded.err;
  std::vector<Json> a = results(recorded.out), b = results(made.out);
  ASSERT_EQ(a.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(a[i]["clusters"], b[i]["clusters"]);
    EXPECT_EQ(a[i]["stamp_ns"], 100'000'000 * i);
  }
  ascii("timed/1317384506.5.pcd", {"1 2 3"});
  const Result timed = stream({"--source", at("timed"), "--rate", "max", "--stamps", "name"});
  ASSERT_EQ(timed.status, 0) << timed.err;
  EXPECT_EQ(results(timed.out)[0]["stamp_ns"], 1'317'384'506'500'000'000);
}

TEST_F(BvStream, SaysOnceThatThereIsNoGround) {
  std::vector<std::string> wall;
  for (int i = 0; i < 120; ++i)
    wall.push_back("3 " + std::to_string(0.1 * (i % 10)) + ' ' + std::to_string(0.1 * (i / 10)));
  std::filesystem::create_directory(at("walls"));
  for (const char* name : {"walls/1.pcd", "walls/2.pcd", "walls/3.pcd"})
    ascii(name, wall);
  const Result result = stream({"--source", at("walls"), "--rate", "max", "--ground", "plane"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.error_lines(), 1u) << result.err;
  EXPECT_THAT(result.err, HasSubstr("walls/1.pcd: frame 0: no ground found (up is z): try --up"));
}

std::set<int> tracks_of(const std::vector<Json>& frames, std::size_t first, std::size_t end) {
  std::set<int> tracks;
  for (std::size_t i = first; i < end; ++i)
    for (const Json& cluster : frames[i]["clusters"])
      if (cluster["track"].is_number()) tracks.insert(cluster["track"].get<int>());
  return tracks;
}

TEST_F(BvStream, EachPassOfALoopHasTracksOfItsOwnAndLaterStamps) {
  const std::string clouds = synth("street-sequence:6:1");
  std::filesystem::create_directory(at("named"));
  for (int i = 0; i < 6; ++i) {
    const std::string number = std::to_string(i), name = "/000000000" + number + ".pcd";
    std::filesystem::copy_file(clouds + name, at("named/1700000000." + number + ".pcd"));
  }
  for (const std::string& stamps : {std::string("rate"), std::string("name")}) {
    const Result result =
        stream({"--source", stamps == "name" ? at("named") : clouds, "--stamps", stamps, "--rate", "max",
                "--loop", "2", "--track", "--range", "1:40", "--min-size", "30", "--volume", "aabb"});
    ASSERT_EQ(result.status, 0) << result.err;
    const std::vector<Json> frames = lines(result.out);
    ASSERT_EQ(frames.size(), 12U);
    for (std::size_t i = 1; i < 12; ++i)
      EXPECT_GT(frames[i]["stamp_ns"].get<std::int64_t>(), frames[i - 1]["stamp_ns"].get<std::int64_t>());
    const std::set<int> first = tracks_of(frames, 0, 6), second = tracks_of(frames, 6, 12);
    EXPECT_GT(first.size(), 10U);
    EXPECT_EQ(second.size(), first.size());
    EXPECT_GT(*second.begin(), *first.rbegin());
    for (const Json& cluster : frames[6]["clusters"])
      EXPECT_TRUE(cluster["track"].is_null());
  }
}

}  // namespace
}  // namespace pcl_bv::test
