// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of gigabytes, whose volumes are known, in little memory.

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <vector>

#include "command.h"

namespace pcl_bv::test {
namespace {

// Evenly in [0, 1).
class Random {
 public:
  float operator()() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<float>(state_ >> 40) * 0x1p-24F;
  }

 private:
  std::uint64_t state_ = 1;
};

template <std::size_t values>
using Write = std::function<void(std::array<float, values>& point)>;

class BigFile : public PcdBv {
 protected:
  template <std::size_t values>
  static void write_points(std::size_t count, std::ofstream& file, const Write<values>& write) {
    std::vector<std::array<float, values>> part(1'000'000);
    for (std::size_t first = 0; first < count; first += part.size()) {
      for (auto& point : part)
        write(point);
      file.write(reinterpret_cast<const char*>(part.data()),
                 static_cast<std::streamsize>(part.size() * sizeof part[0]));
    }
  }
};

class TwoGigabytes : public BigFile {
 protected:
  // 16 bytes each, and more points than 2^27.
  static constexpr std::size_t kPoints = 140'000'000;

  // x y z intensity inside the unit cube, but for one point far behind.
  std::string write() const {
    const std::string path = at("big.pcd");
    std::ofstream file(path, std::ios::binary);
    const std::string n = std::to_string(kPoints);
    file << "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH " << n
         << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << n << "\nDATA binary\n";
    Random random;
    std::size_t written = 0;
    write_points<4>(kPoints, file, [&](std::array<float, 4>& point) {
      for (float& value : point)
        value = random();
      if (written == 5) point = {0, 0, 0, 0};
      if (++written == kPoints) point = {3, 1, 2, 0};
    });
    return path;
  }

  Result in_64_megabytes(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(),
                     {"-c", "ulimit -d 64000; exec \"$0\" \"$@\"", PCL_BV_BIN_DIR "/pcd_bv"});
    return run(arguments, {.program = "/bin/sh"});
  }
};

TEST_F(TwoGigabytes, AreFittedAndCheckedInSixtyFourMegabytes) {
  const std::string path = write();
  ASSERT_GT(std::filesystem::file_size(path), std::size_t{2} << 30);
  const Result result = in_64_megabytes({"--volume", "aabb,dop26,sphere,obb-dito14,obb-yaw", "--threads", "2",
                                         "--check", "--info", "--format", "jsonl", path});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json report = result.json();
  EXPECT_EQ(report["points"], kPoints);
  const Json& volumes = report["clusters"][0]["volumes"];
  EXPECT_EQ(volumes[0]["min"], Json::parse("[0,0,0]"));
  EXPECT_EQ(volumes[0]["max"], Json::parse("[3,1,2]"));
  for (const Json& volume : volumes)
    EXPECT_EQ(volume["outside"], 0) << volume["method"];
  EXPECT_EQ(report["info"]["zero"], 1);

  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  const Result cut = in_64_megabytes({path});
  EXPECT_EQ(cut.status, 1);
  EXPECT_THAT(cut.err, testing::HasSubstr("truncated: 140000000 points of 16 bytes need 2240000000 bytes"));
}

class BillionPoints : public BigFile {
 protected:
  static constexpr std::size_t kPoints = 1'000'000'000;

  // 12 GB.
  std::string write(const Write<3>& point) const {
    const std::string path = at("billion.pcd");
    std::ofstream file(path, std::ios::binary);
    file << header(kPoints, "binary");
    write_points<3>(kPoints, file, point);
    return path;
  }

  // The most that any command of this test has had in memory, in KiB.
  static long resident() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return usage.ru_maxrss;
  }

  void expect_little_memory(const std::string& path, const std::vector<std::string>& methods) const {
    ASSERT_EQ(run({"--version"}).status, 0);
    const long program = resident();
    for (const std::string& method : methods) {
      const Result result = run({"--volume", method, "--threads", "2", "--format", "jsonl", path});
      ASSERT_EQ(result.status, 0) << result.err;
      EXPECT_EQ(result.json()["points"], kPoints);
      EXPECT_LE(resident() - program, 16 << 10) << method;
      RecordProperty(method + " KiB", static_cast<int>(resident() - program));
    }
  }
};

TEST_F(BillionPoints, InAPlaneTakeSixteenMegabytesForEveryMethod) {
  Random random;
  const std::string path = write([&](std::array<float, 3>& p) {
    p = {100 * random(), 100 * random(), 1.5F};
  });
  expect_little_memory(path, {"dop26", "sphere-epos98", "sphere", "obb-pca", "obb-dito14", "obb-yaw",
                              "obb-lshape", "obb-min", "prism", "cylinder", "capsule", "ellipsoid", "hull"});
}

// Nearly all of them are vertices of its hull.
TEST_F(BillionPoints, OnASphereTakeSixteenMegabytesForMethodsWithoutAHull) {
  Random random;
  const std::string path = write([&](std::array<float, 3>& p) {
    const float z = 2 * random() - 1, angle = 6.2831853F * random(), r = std::sqrt(std::max(0.0F, 1 - z * z));
    p = {10 * r * std::cos(angle), 10 * r * std::sin(angle), 10 * z};
  });
  expect_little_memory(path, {"dop26", "sphere-ritter", "sphere-epos98", "sphere", "obb-pca", "obb-dito14",
                              "obb-yaw", "obb-lshape"});
}

// One cloud in twenty files, of PCL_BV_LARGE_POINTS points (a billion).
class InParts : public BigFile {
 protected:
  static constexpr std::size_t kTiles = 20;

  static std::size_t points() {
    const char* const asked = std::getenv("PCL_BV_LARGE_POINTS");
    return asked != nullptr ? std::stoul(asked) : 1'000'000'000;
  }

  // Gaussian, as sums of three.
  std::string write() const {
    Random random;
    const std::size_t count = points() / kTiles;
    for (std::size_t tile = 0; tile < kTiles; ++tile) {
      const std::string path = at("tiles/" + std::to_string(tile) + ".pcd");
      std::filesystem::create_directories(at("tiles"));
      std::ofstream file(path, std::ios::binary);
      file << header(count, "binary");
      std::vector<float> part(3 * (count / 50));
      for (std::size_t i = 0; i < 50; ++i) {
        for (float& c : part)
          c = random() + random() + random() + static_cast<float>(tile);
        file.write(reinterpret_cast<const char*>(part.data()),
                   static_cast<std::streamsize>(part.size() * sizeof part[0]));
      }
    }
    return at("tiles");
  }

  Result measured(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{"-f", "%M", "-o", at("kib"), PCL_BV_BIN_DIR "/pcd_bv"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run(all, {.program = "/usr/bin/time"});
  }

  long kib() const { return std::stol(read_file(at("kib"))); }

  // Of the rank that has the most.
  static long kib_of_ranks(const Result& result) {
    const std::size_t at_most = result.err.find("at most ");
    return at_most == std::string::npos ? -1 : std::stol(result.err.substr(at_most + 8));
  }

  Result ranks(std::size_t count, const std::string& volumes, const std::string& input) const {
    for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"})
      setenv(name, "1", 1);
    return run({"--oversubscribe", "-n", std::to_string(count), PCL_BV_BIN_DIR "/pcd_bv_mpi", "--together",
                "--timings", "--format", "jsonl", "--volume", volumes, input},
               {.program = PCL_BV_MPIEXEC});
  }

  static constexpr const char* kVolumes = "dop26,sphere,obb-pca,obb-dito14,obb-yaw,obb-min";
};

TEST_F(InParts, TakesSixteenMegabytesForSharesAndMergesToTheBitsOfAll) {
  const std::string tiles = write();
  const Result small = measured({"--together", "--threads", "1", "synth:gauss:10"});
  ASSERT_EQ(small.status, 0) << small.err;
  const long program = kib();
  const Result whole =
      measured({"--together", "--threads", "1", "--volume", kVolumes, "--format", "jsonl", tiles});
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_EQ(whole.json()["points"], points() / kTiles / 50 * 50 * kTiles);
  EXPECT_LE(kib() - program, 16 << 10);
  RecordProperty("together KiB", static_cast<int>(kib() - program));

  std::vector<std::string> merge{"--merge", "--volume", kVolumes, "--format", "jsonl"};
  for (const std::string part : {"0/3", "1/3", "2/3"}) {
    merge.push_back(at("share" + part.substr(0, 1)));
    ASSERT_EQ(measured({"--partial", merge.back(), "--part", part, "--threads", "1", tiles}).status, 0);
    EXPECT_LE(kib() - program, 16 << 10);
    EXPECT_LE(std::filesystem::file_size(merge.back()), std::size_t{1} << 20);
  }
  EXPECT_EQ(run(merge).out, whole.out);

  const long idle = kib_of_ranks(ranks(2, "aabb", "synth:gauss:10"));
  const Result over_ranks = ranks(2, kVolumes, tiles);
  ASSERT_EQ(over_ranks.status, 0) << over_ranks.err;
  EXPECT_EQ(over_ranks.json()["clusters"], whole.json()["clusters"]);
  EXPECT_LE(kib_of_ranks(over_ranks) - idle, 16 << 10) << over_ranks.err;
  std::cout << over_ranks.err;
}

}  // namespace
}  // namespace pcl_bv::test
