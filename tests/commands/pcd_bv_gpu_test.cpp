// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// pcd_bv --gpu, with whatever devices this machine has; none is also a case.

#include <gmock/gmock.h>

#include "command.h"
#include "pcl_bv/gpu/gpu_device.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

bool have_device() {
  try {
    return !gpu_devices().empty();
  } catch (const GpuError&) {
    return false;
  }
}

const std::vector<std::string> kWork = {"--volume", "aabb,dop26,sphere-epos26", "--format", "jsonl",
                                        "synth:gauss:100000:3"};

std::vector<std::string> work_on(const std::string& device) {
  std::vector<std::string> arguments = kWork;
  arguments.insert(arguments.begin(), {"--gpu", device});
  return arguments;
}

TEST_F(PcdBv, OnADeviceWritesTheSameBytes) {
  if (!have_device()) GTEST_SKIP() << "no device for Vulkan 1.1 (install mesa-vulkan-drivers)";
  const Result expected = run(kWork);
  const Result result = run(work_on("0"));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, expected.out);
  const std::vector<std::string> clusters = {"--cluster", "0.5",   "--volume",          "dop14,obb-lshape",
                                             "--format",  "jsonl", "synth:street:60000"};
  std::vector<std::string> on_device = clusters;
  on_device.insert(on_device.begin(), {"--gpu", "0"});
  EXPECT_EQ(run(on_device).out, run(clusters).out);
}

TEST_F(PcdBv, NamesTheDevicesIfTheRequestedOneIsAbsent) {
  for (const std::string device : {"no such card", "99"}) {
    const Result result = run(work_on(device));
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_THAT(result.err, StartsWith("pcd_bv: --gpu: no "));
  }
}

TEST_F(PcdBv, WithGpuAutoAlwaysWritesTheSameBytes) {
  const Result result = run(work_on("auto"));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, run(kWork).out);
  EXPECT_LE(result.error_lines(), 1U) << result.err;
}

TEST_F(PcdBv, ListsDevicesWithItsVersionIfAsked) {
  EXPECT_THAT(run({"--version", "--gpu", "auto"}).out, HasSubstr("\ngraphics cards:"));
  EXPECT_THAT(run({"--version"}).out, testing::Not(HasSubstr("graphics")));
}

TEST_F(PcdBv, RefusesADeviceForPartialResults) {
  const Result result = run({"--gpu", "auto", "--partial", at("p"), "synth:gauss:100:3"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("--gpu: cannot be combined with --partial"));
}

}  // namespace
}  // namespace pcl_bv::test
