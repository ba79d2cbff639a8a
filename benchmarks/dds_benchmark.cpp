// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// bv_stream between ROS 2's topics on the loopback: clouds of 2 MB, 20 a second, from this process, and the
// markers of their objects back in it. Counters: how many were answered, milliseconds from sending a cloud to
// having its markers, and what bv_stream has resident after a tenth of the time and at its end.
// PCL_BV_BENCH_CLOUDS: how many (600).

#include <benchmark/benchmark.h>

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>

#include "child_process.h"
#include "pcl_bv/messages/results.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/synth/street.h"
#include "program.h"
#include "stream/middleware.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;
constexpr std::chrono::milliseconds kPeriod{50};

// Points of 16 bytes, as drivers send them: x, y, z, intensity.
std::vector<std::byte> cloud_message(std::size_t number) {
  StreetOptions street;
  street.points = points_in_this_run(130'000);
  const std::vector<float> xyz = make_street_frame(street, number).cloud.xyz;
  std::vector<float> points;
  for (std::size_t i = 0; i < xyz.size(); i += 3)
    points.insert(points.end(), {xyz[i], xyz[i + 1], xyz[i + 2], 1});
  msg::PointCloud2 cloud;
  cloud.header.frame_id = "lidar";
  cloud.width = static_cast<std::uint32_t>(points.size() / 4);
  cloud.point_step = 16;
  cloud.row_step = 16 * cloud.width;
  cloud.fields = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"intensity", 12, 7, 1}};
  cloud.data = {reinterpret_cast<const std::byte*>(points.data()), 4 * points.size()};
  std::vector<std::byte> bytes;
  write_cdr(cloud, bytes);
  return bytes;
}

class Talk {
 public:
  Talk()
      : carrier_(middleware("dds").carrier("")),
        markers_(middleware("dds").receiver("/bv/markers", {msg::MarkerArray::ros_type})),
        points_(carrier_->add_topic({"/points", msg::PointCloud2::ros_type})) {
    for (std::size_t i = 0; i < (tiny() ? 1U : 20U); ++i)
      clouds_.push_back(cloud_message(i));
    const auto end = Clock::now() + std::chrono::seconds(20);
    // The other side knows us when it answers.
    while (!carrier_->has_subscribers(points_) || answers_.empty()) {
      if (Clock::now() > end) throw std::runtime_error("bv_stream does not answer");
      if (carrier_->has_subscribers(points_)) send(0);
      listen_until(Clock::now() + kPeriod);
    }
    listen_until(Clock::now() + 4 * kPeriod);
    answers_.clear();
  }

  // The number of a cloud, above 0, is its stamp's seconds.
  void send(std::uint32_t number) {
    std::vector<std::byte>& cloud = clouds_[number % clouds_.size()];
    std::memcpy(cloud.data() + 4, &number, 4);  // behind the encapsulation
    sent_[number] = Clock::now();
    carrier_->send(points_, 0, cloud);
  }

  void listen_until(Clock::time_point end) {
    for (Clock::time_point now; (now = Clock::now()) < end;) {
      ReceivedMessage message;
      if (!markers_->next(message, std::chrono::duration_cast<std::chrono::milliseconds>(end - now)))
        continue;
      const auto came = Clock::now();
      msg::MarkerArray array;
      read_cdr(message.data, message.size, array);
      if (array.markers.empty()) throw std::runtime_error("a street without objects");
      const auto number = static_cast<std::uint32_t>(array.markers.front().header.stamp.sec);
      answers_[number] = Milliseconds(came - sent_[number]).count();
    }
  }

  std::vector<double> latencies() const {
    std::vector<double> sorted;
    for (const auto& [number, ms] : answers_)
      sorted.push_back(ms);
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

 private:
  std::unique_ptr<MessageSender> carrier_;
  std::unique_ptr<MessageReceiver> markers_;
  std::size_t points_;
  std::vector<std::vector<std::byte>> clouds_;
  std::map<std::uint32_t, Clock::time_point> sent_;
  std::map<std::uint32_t, double> answers_;
};

void clouds_to_markers(benchmark::State& state) {
  const char* const wanted = std::getenv("PCL_BV_BENCH_CLOUDS");
  const auto clouds =
      static_cast<std::uint32_t>(times_in_this_run(wanted == nullptr ? 600 : std::atoi(wanted)));
  for (auto _ : state) {
    const RunningProcess node({PCL_BV_BIN_DIR "/bv_stream", "--source", "dds:/points", "--sink", "dds:/bv"});
    Talk talk;
    double early = 0;
    const auto begin = Clock::now();
    for (std::uint32_t i = 1; i <= clouds; ++i) {
      talk.send(i);
      talk.listen_until(begin + i * kPeriod);
      if (i == clouds / 10) early = node.resident_mib();
    }
    talk.listen_until(Clock::now() + 4 * kPeriod);
    const std::vector<double> ms = talk.latencies();
    if (ms.empty()) throw std::runtime_error("no answer");
    const auto at = [&](double share) {
      return ms[static_cast<std::size_t>(share * static_cast<double>(ms.size() - 1))];
    };
    state.counters["sent"] = clouds;
    state.counters["answered"] = static_cast<double>(ms.size());
    state.counters["p50_ms"] = at(0.5);
    state.counters["p99_ms"] = at(0.99);
    state.counters["max_ms"] = ms.back();
    state.counters["early_mib"] = early;
    state.counters["late_mib"] = node.resident_mib();
  }
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  setenv("ROS_LOCALHOST_ONLY", "1", 1);
  setenv("ROS_DOMAIN_ID", std::to_string(1 + getpid() % 200).c_str(), 1);
  benchmark::RegisterBenchmark("dds/clouds-to-markers", pcl_bv::bench::clouds_to_markers)
      ->Iterations(1)
      ->UseRealTime();
  return pcl_bv::bench::run_program(argc, argv);
}
