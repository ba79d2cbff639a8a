// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What both commands make of recordings, and say of what is none.

#include <gmock/gmock.h>

#include <sstream>

#include "../recording/made_packets.h"
#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

class Recordings : public PcdBv {
 protected:
  Result stream(const std::vector<std::string>& arguments) const {
    Surroundings surroundings;
    surroundings.program = "bv_stream";
    return run(arguments, surroundings);
  }

  // A little of one revolution, a whole one, and a little of the next.
  std::string capture() const {
    std::vector<std::string> payloads;
    for (unsigned azimuth = 35'000; azimuth < 35'000 + 38'000; azimuth += 480)
      payloads.push_back(packet(azimuth % 36'000, 40, 0x37, 0x22));
    return file("drive.pcap", pcap(payloads));
  }
};

TEST_F(Recordings, ACaptureOfPacketsIsACloudForEachRevolution) {
  const Json clouds = run({"--volume", "aabb", "--format", "json", capture()}).json();
  ASSERT_EQ(clouds.size(), 3U);
  const Result streamed = stream({"--source", at("drive.pcap"), "--rate", "max", "--cluster", "0", "--ground",
                                  "none", "--range", "0:inf", "--volume", "aabb"});
  std::istringstream lines(streamed.out);
  std::size_t i = 0;
  for (std::string line; std::getline(lines, line); ++i) {
    const Json frame = Json::parse(line);
    EXPECT_EQ(clouds[i]["file"], at("drive.pcap") + '#' + std::to_string(i));
    EXPECT_EQ(clouds[i]["points"], frame["points"]);
    EXPECT_EQ(clouds[i]["clusters"][0]["volumes"], frame["clusters"][0]["volumes"]);
  }
  EXPECT_EQ(i, 3U);
  const Result none = run({"--topic", "1.2.3.4:2368", at("drive.pcap")});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("no packets of a sensor at 1.2.3.4:2368; there are 0.0.0.0:2368"));
}

TEST_F(Recordings, DamageThatIsFoundWhileReadingIsSaid) {
  ASSERT_EQ(stream({"--source", "synth:street-sequence:6", "--rate", "max", "--sink",
                    "mcap:" + at("damaged.mcap") + ",points"})
                .status,
            0);
  std::string bytes = read_file(at("damaged.mcap"));
  bytes.replace(bytes.size() / 2, 40, 40, '\x55');
  const Result result = run({"--volume", "aabb", file("damaged.mcap", bytes)});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr("damaged.mcap: skipped the "));
  EXPECT_THAT(result.err, HasSubstr("clouds of the recording can be read, and numbers count these"));
}

TEST_F(Recordings, AnEmptyFileOfAnyKindIsCalledEmpty) {
  for (const char* name :
       {"a.bag", "a.mcap", "a.db3", "a.pcap", "a.pcapng", "a.pcd", "a.ply", "a.las", "a.bin"}) {
    const std::string empty = file(name, "");
    const Result once = run({empty});
    EXPECT_EQ(once.status, 1) << name;
    EXPECT_THAT(once.err, HasSubstr(std::string(name) + ": empty file")) << name;
    EXPECT_EQ(once.error_lines(), 1U) << once.err;
    const Result streamed = stream({"--source", empty, "--rate", "max"});
    EXPECT_EQ(streamed.status, 1) << name;
    EXPECT_THAT(streamed.err, HasSubstr("empty file")) << name;
    EXPECT_EQ(streamed.error_lines(), 1U) << streamed.err;
  }
  EXPECT_THAT(run({at("gone.bag")}).err, HasSubstr("no such file"));
}

TEST_F(Recordings, AnOptionWithoutItsValueIsNamed) {
  const Result looped = stream({"--source", "synth:street-sequence:1", "--loop", "--track"});
  EXPECT_EQ(looped.status, 2);
  EXPECT_THAT(looped.err, HasSubstr("--loop needs a value (N), but the option --track comes next"));
  EXPECT_THAT(run({"--cluster", "--volume", "aabb", "synth:box"}).err,
              HasSubstr("--cluster needs a value (TOL[:PER_METRE]), but the option --volume comes next"));
  EXPECT_EQ(run({"--volume", "aabb", "--", "--volume"}).status,
            1);  // a file of that name, which is not there
}

}  // namespace
}  // namespace pcl_bv::test
