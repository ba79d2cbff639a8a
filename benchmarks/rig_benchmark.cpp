// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Two clouds of 130 000 points become one, in the frame of the robot and at one time: transform, times and
// merge (CloudMerger), then deskewing. One thread, each instruction set. Points of 16 bytes and of 22 bytes,
// as drivers send them, with 32-bit times in nanoseconds.

#include <benchmark/benchmark.h>

#include <cstring>
#include <memory>
#include <vector>

#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/synth/street.h"
#include "pipeline/deskew/deskewer.h"
#include "program.h"
#include "stream/rig/merged_cloud.h"
#include "stream/rig/mounting_pose.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

constexpr std::int64_t kStamp = 1'700'000'000'000'000'000, kStep = 100'000'000;

// A cloud of records with x, y, z at the beginning and the time at the end.
Frame timed_cloud(std::size_t record, std::uint64_t seed) {
  StreetOptions street;
  street.points = points_in_this_run(130'000);
  street.seed = seed;
  const std::vector<float> xyz = make_street_frame(street, 0).cloud.xyz;
  const std::size_t count = xyz.size() / 3;
  const auto bytes = std::make_shared<std::vector<std::byte>>(count * record);
  for (std::size_t i = 0; i < count; ++i) {
    std::byte* const at = bytes->data() + i * record;
    std::memcpy(at, &xyz[3 * i], 3 * sizeof(float));
    const auto time = static_cast<std::uint32_t>(1e8 * static_cast<double>(i) / static_cast<double>(count));
    std::memcpy(at + record - sizeof time, &time, sizeof time);
  }
  Frame frame;
  frame.points = PointView::of(reinterpret_cast<const float*>(bytes->data()), record, count);
  frame.times = FieldView{bytes->data() + record - 4, record, 'U', 4};
  frame.header.stamp_ns = kStamp;
  frame.owner = bytes;
  return frame;
}

// A robot that drives at 10 m/s and turns at 0.5 rad/s.
Pose pose_at(std::int64_t stamp_ns) {
  const double seconds = 1e-9 * static_cast<double>(stamp_ns - kStamp);
  return pose_of_angles({10 * seconds, 0, 0}, {0, 0, 0.5 * seconds});
}

void merge_two_clouds(benchmark::State& state, Isa isa, std::size_t record, bool deskewed) {
  const std::vector<Frame> frames{timed_cloud(record, 1), timed_cloud(record, 2)};
  const std::vector<MountedCloud> clouds{{&frames[0], "front", pose_of_angles({1.5, 0, 0}, {0, 0.05, 0.1})},
                                         {&frames[1], "rear", pose_of_angles({-1.2, 0, 0}, {0, 0, 3.1})}};
  CloudMerger merger(deskewed, isa);
  Deskewer deskewer;
  const Execution execution{Serial{}, isa};
  for (auto _ : state) {
    Frame merged;
    merged.header.stamp_ns = kStamp;
    merger.merge(clouds, merged);
    if (!deskewed) continue;
    deskewer.remember(pose_at(kStamp - kStep), kStamp - kStep, true);
    merged.pose = pose_at(kStamp);
    DeskewResult result;
    const FloatEnvironment environment;
    deskewer.apply(merged, execution, result);
    if (!result.moved()) state.SkipWithError("the points were not moved");
    benchmark::DoNotOptimize(result.points.data);
  }
}

void add_rows() {
  for (const Isa isa : usable_isas()) {
    for (const std::size_t record : {16, 22}) {
      for (const bool deskewed : {false, true}) {
        const std::string name = "rig/two-clouds-merged" + std::string(deskewed ? "-and-deskewed/" : "/") +
                                 std::to_string(record) + "-bytes/" + std::string(isa_name(isa));
        benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
          merge_two_clouds(state, isa, record, deskewed);
        })->Unit(benchmark::kMillisecond);
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  pcl_bv::bench::add_rows();
  return pcl_bv::bench::run_program(argc, argv);
}
