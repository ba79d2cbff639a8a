// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the system refuses: inputs that cannot be read though they are there, outputs that find no room.

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <limits>

#include "command.h"
#include "devices.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(PcdBv, WhatIsNoOrdinaryFileIsRefusedAndNeverWaitedFor) {
  ASSERT_EQ(mkfifo(at("pipe.pcd").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(at("pipe.bin").c_str(), 0600), 0);
  fs::create_symlink("/proc/self/mem", at("memory.pcd"));
  fs::create_symlink("/dev/null", at("null.ply"));
  fs::create_symlink("loop.pcd", at("loop.pcd"));
  for (const std::string& input :
       {at("pipe.pcd"), at("pipe.bin"), at("memory.pcd"), at("null.ply"), at("loop.pcd"), std::string(),
        file("cloud.txt", "one two\n"), at(std::string(300, 'n') + ".pcd")}) {
    SCOPED_TRACE(input);
    const Result result = run({"--format", "jsonl", input});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_TRUE(result.json().contains("error"));
  }
}

TEST_F(PcdBv, WhatMayNotBeReadIsStatusOne) {
  const std::string secret = ascii("folder/secret.pcd", {"1 2 3"});
  const auto run_without_privileges = [&](const std::string& input) {
    if (geteuid() != 0) return run({input});
    return run({"--inh-caps=-all", "--bounding-set=-all", PCL_BV_BIN_DIR "/pcd_bv", input},
               {.program = "/usr/bin/setpriv"});
  };
  fs::permissions(secret, fs::perms::none);
  const Result file = run_without_privileges(secret);
  fs::permissions(at("folder"), fs::perms::none);
  const Result folder = run_without_privileges(at("folder"));
  fs::permissions(at("folder"), fs::perms::owner_all);
  EXPECT_EQ(file.status, 1);
  EXPECT_EQ(file.err, "pcd_bv: " + secret + ": permission denied\n");
  EXPECT_EQ(folder.status, 1);
  EXPECT_EQ(folder.error_lines(), 1U);
  EXPECT_THAT(folder.err, StartsWith("pcd_bv: " + at("folder") + ": "));
}

TEST_F(PcdBv, AFullDiskUnderAnyFileIsStatusOneAndTheReportIsStillMade) {
  const std::string full = device_in(at(""), Device::full).string();
  if (full.empty()) GTEST_SKIP() << "no device can be made";
  const std::string cloud = ascii("c.pcd", {"0 0 0", "1 2 3"});
  for (const std::string option : {"--output", "--labels", "--mesh", "--image"}) {
    SCOPED_TRACE(option);
    const Result result = run({option, full, cloud});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_THAT(result.err, StartsWith("pcd_bv: " + full + ": "));
    EXPECT_THAT(result.err, HasSubstr("no space left on device"));
    EXPECT_EQ(result.out.empty(), option == "--output");
  }
}

TEST_F(PcdBv, AFolderThatTakesNoFileIsStatusOne) {
  const std::string cloud = ascii("c.pcd", {"0 0 0"});
  for (const std::string target : {"--output=/proc/out", "--labels=/proc/l.pcd", "--mesh=/proc/m.ply",
                                   "--image=/proc/i.svg", "--labels=/proc/no/l.pcd"}) {
    SCOPED_TRACE(target);
    const Result result = run({target, cloud});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_THAT(result.err, StartsWith("pcd_bv: " + target.substr(target.find('=') + 1) + ": "));
  }
}

TEST_F(PcdBv, AnInputWhoseFilesFailIsCountedAsFailed) {
  const std::string a = ascii("a.pcd", {"0 0 0"}), b = ascii("b.pcd", {"0 0 0"});
  fs::create_directories(at("labels/a.pcd"));  // where a file would have to be
  const Result result = run({"--labels", at("labels"), a, b});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("pcd_bv: 2 files: 1 done, 1 failed, 2 points, "));
  EXPECT_EQ(read_pcd(at("labels/b.pcd")).size(), 1U);
}

TEST_F(PcdBv, FailuresOfEveryFormat) {
  const std::string missing = at("missing.pcd");
  EXPECT_EQ(run({missing}).out, "");
  EXPECT_EQ(run({"--format", "jsonl", missing}).out,
            "{\"schema\":1,\"file\":\"" + missing + "\",\"error\":\"no such file or directory\"}\n");
  EXPECT_EQ(run({"--format", "json", missing}).json().size(), 1U);
  EXPECT_EQ(run({"--format", "json", "--output", at("o"), missing}).status, 1);
  EXPECT_EQ(Json::parse(read_file(at("o")))[0]["file"], missing);
}

TEST_F(PcdBv, NothingFiniteIsNoErrorInAnyFormat) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const float points[2][4] = {{nan, 2, 3, 0}, {1, nan, nan, 0}};
  const std::string sixteen(reinterpret_cast<const char*>(points), sizeof points);
  const std::string twelve = sixteen.substr(0, 12) + sixteen.substr(16, 12);
  // LZF: one literal run of 12 bytes for each field (binary_compressed stores fields one after another).
  const std::string fields = sixteen.substr(0, 4) + sixteen.substr(16, 4) + sixteen.substr(4, 4) +
                             sixteen.substr(20, 4) + sixteen.substr(8, 4) + sixteen.substr(24, 4);
  const std::string packed = std::string("\x17", 1) + fields;
  const std::string sizes("\x19\0\0\0\x18\0\0\0", 8);
  const std::string ply =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (const std::string& input :
       {ascii("a.pcd", {"nan 2 3", "1 nan nan"}), file("b.pcd", header(2, "binary") + twelve),
        file("c.pcd", header(2, "binary_compressed") + sizes + packed), file("d.bin", sixteen),
        file("e.ply", "ply\nformat ascii 1.0\n" + ply + "nan 2 3\n1 nan nan\n"),
        file("f.ply", "ply\nformat binary_little_endian 1.0\n" + ply + twelve)}) {
    SCOPED_TRACE(input);
    for (const std::string format : {"text", "json", "jsonl", "csv"}) {
      const Result result =
          run({"--format", format, "--check", "--info", "--volume", "all,hull,best", "--labels", at("l.pcd"),
               "--mesh", at("m.vtp"), "--image", at("i.svg"), input});
      EXPECT_EQ(result.status, 0) << result.err;
      EXPECT_THAT(result.out, HasSubstr(input));
      EXPECT_EQ(read_pcd(at("l.pcd")).size(), 2U);
    }
    const Result clusters = run({"--format", "jsonl", "--ground", "zones", "--cluster", "1", input});
    EXPECT_EQ(clusters.status, 0) << clusters.err;
    EXPECT_EQ(clusters.json()["counts"]["nonfinite"], 2);
  }
}

TEST_F(PcdBv, ValuesAtTheEdgesAreTakenAndBeyondThemRefused) {
  const std::string cloud = ascii("c.pcd", {"0 0 0", "1 2 3"});
  const auto status = [&](std::vector<std::string> arguments) {
    arguments.push_back(cloud);
    return run(arguments).status;
  };
  EXPECT_EQ(status({"--threads", "1024"}), 0);
  EXPECT_EQ(status({"--threads", "1025"}), 2);
  EXPECT_EQ(status({"--threads", ""}), 2);
  EXPECT_EQ(status({"--threads", "0x2"}), 2);
  EXPECT_EQ(status({"--range", "0:0"}), 0);
  EXPECT_EQ(status({"--range", ":"}), 2);
  EXPECT_EQ(status({"--range", "0:"}), 2);
  EXPECT_EQ(status({"--range", "0:1m"}), 2);
  EXPECT_EQ(status({"--cluster", "1e-38"}), 0);
  EXPECT_EQ(status({"--cluster", "nan"}), 2);
  EXPECT_EQ(status({"--cluster", ""}), 2);
  EXPECT_EQ(status({"--cluster", "1", "--min-size", "0", "--max-size", "1"}), 0);
  EXPECT_EQ(status({"--cluster", "1", "--max-size", "18446744073709551616"}), 2);
  EXPECT_EQ(status({"--ground", "plane", "--sensor-height", "inf"}), 2);
  EXPECT_EQ(status({"--sensor-height", "1"}), 2);
  EXPECT_EQ(status({"--ground", "none", "--sensor-height", "1"}), 0);
  EXPECT_EQ(status({"--view", "top", "--image", at("i.png")}), 0);
  EXPECT_EQ(status({"--format", "JSON"}), 2);
  EXPECT_EQ(status({"--isa", ""}), 2);
  EXPECT_EQ(status({"--image", ""}), 2);
  EXPECT_EQ(status({"--labels", ""}), 2);
  EXPECT_EQ(status({"--check=maybe"}), 2);
  EXPECT_EQ(status({"--chec"}), 2);
}

TEST_F(PcdBv, EveryGrowthHoldsEveryPoint) {
  for (const std::string growth : {"sequential", "stationary", "deferred"}) {
    EXPECT_EQ(
        run({"--growth", growth, "--volume", "sphere-ritter,sphere-epos6", "--check", "synth:gauss:20000"})
            .status,
        0)
        << growth;
  }
}

}  // namespace
}  // namespace pcl_bv::test
