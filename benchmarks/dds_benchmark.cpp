// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// bv_stream between ROS 2's topics on the loopback: clouds of 2 MB, 20 a second, from this process, and the
// markers of their objects back in it. Once from one sensor, once in four parts from the sensors of a rig,
// with their transforms. Counters: how many were answered, milliseconds from sending a cloud to having its
// markers, and what bv_stream has resident after a tenth of the time and at its end. PCL_BV_BENCH_CLOUDS: how
// many (600).

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

std::string frame_of(std::size_t sensor) {
  return "lidar" + std::to_string(sensor);
}

// Points of 16 bytes, as drivers send them: x, y, z, intensity.
std::vector<std::byte> cloud_message(std::size_t number, std::size_t sensor, std::size_t sensors) {
  StreetOptions street;
  street.points = points_in_this_run(130'000) / sensors;
  street.seed += sensor;
  const std::vector<float> xyz = make_street_frame(street, number).cloud.xyz;
  std::vector<float> points;
  for (std::size_t i = 0; i < xyz.size(); i += 3)
    points.insert(points.end(), {xyz[i], xyz[i + 1], xyz[i + 2], 1});
  msg::PointCloud2 cloud;
  cloud.header.frame_id = frame_of(sensor);
  cloud.width = static_cast<std::uint32_t>(points.size() / 4);
  cloud.point_step = 16;
  cloud.row_step = 16 * cloud.width;
  cloud.fields = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"intensity", 12, 7, 1}};
  cloud.data = {reinterpret_cast<const std::byte*>(points.data()), 4 * points.size()};
  std::vector<std::byte> bytes;
  write_cdr(cloud, bytes);
  return bytes;
}

// The poses of the sensors, half a metre from one another.
std::vector<std::byte> transforms_message(std::size_t sensors) {
  msg::TFMessage message;
  for (std::size_t sensor = 0; sensor < sensors; ++sensor) {
    msg::TransformStamped& step = message.transforms.emplace_back();
    step.header.frame_id = "base_link";
    step.child_frame_id = frame_of(sensor);
    step.transform.translation.x = 0.5 * static_cast<double>(sensor);
  }
  std::vector<std::byte> bytes;
  write_cdr(message, bytes);
  return bytes;
}

std::string topic_of(std::size_t sensor) {
  return "/points" + std::to_string(sensor);
}

class Talk {
 public:
  explicit Talk(std::size_t sensors)
      : carrier_(middleware("dds").carrier("")),
        markers_(middleware("dds").receiver("/bv/markers", {msg::MarkerArray::ros_type})),
        clouds_(sensors) {
    const std::size_t transforms = carrier_->add_topic({"/tf_static", msg::TFMessage::ros_type, "cdr", true});
    carrier_->send(transforms, 0, transforms_message(sensors));
    for (std::size_t sensor = 0; sensor < sensors; ++sensor) {
      points_.push_back(carrier_->add_topic({topic_of(sensor), msg::PointCloud2::ros_type}));
      for (std::size_t i = 0; i < (tiny() ? 1U : 20U); ++i)
        clouds_[sensor].push_back(cloud_message(i, sensor, sensors));
    }
    const auto end = Clock::now() + std::chrono::seconds(20);
    // The other side knows us when it answers.
    while (!is_heard() || answers_.empty()) {
      if (Clock::now() > end) throw std::runtime_error("bv_stream does not answer");
      if (is_heard()) send(0);
      listen_until(Clock::now() + kPeriod);
    }
    listen_until(Clock::now() + 4 * kPeriod);
    answers_.clear();
  }

  // The number of a cloud, above 0, is its stamp's seconds.
  void send(std::uint32_t number) {
    sent_[number] = Clock::now();
    for (std::size_t sensor = 0; sensor < points_.size(); ++sensor) {
      std::vector<std::byte>& cloud = clouds_[sensor][number % clouds_[sensor].size()];
      std::memcpy(cloud.data() + 4, &number, 4);  // behind the encapsulation
      carrier_->send(points_[sensor], 0, cloud);
    }
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

  bool is_heard() const {
    return std::all_of(points_.begin(), points_.end(),
                       [&](std::size_t topic) { return carrier_->has_subscribers(topic); });
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
  std::vector<std::size_t> points_;                          // topic of each sensor
  std::vector<std::vector<std::vector<std::byte>>> clouds_;  // of each sensor
  std::map<std::uint32_t, Clock::time_point> sent_;
  std::map<std::uint32_t, double> answers_;
};

std::vector<std::string> command_for(std::size_t sensors) {
  std::vector<std::string> command{PCL_BV_BIN_DIR "/bv_stream", "--sink", "dds:/bv"};
  for (std::size_t sensor = 0; sensor < sensors; ++sensor)
    command.insert(command.end(), {"--source", "dds:" + topic_of(sensor)});
  if (sensors > 1) command.insert(command.end(), {"--target-frame", "base_link"});
  return command;
}

void clouds_to_markers(benchmark::State& state, std::size_t sensors) {
  const char* const wanted = std::getenv("PCL_BV_BENCH_CLOUDS");
  const auto clouds =
      static_cast<std::uint32_t>(times_in_this_run(wanted == nullptr ? 600 : std::atoi(wanted)));
  for (auto _ : state) {
    const RunningProcess node(command_for(sensors));
    Talk talk(sensors);
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
  benchmark::RegisterBenchmark("dds/clouds-to-markers", pcl_bv::bench::clouds_to_markers, 1)
      ->Iterations(1)
      ->UseRealTime();
  benchmark::RegisterBenchmark("dds/clouds-of-four-sensors-to-markers", pcl_bv::bench::clouds_to_markers, 4)
      ->Iterations(1)
      ->UseRealTime();
  return pcl_bv::bench::run_program(argc, argv);
}
