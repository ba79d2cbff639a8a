// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What viewers cost the pipeline: streets of 130 k points every 50 ms on one thread, in turns of 50 frames
// without a viewer, with one that reads all channels, and with one that subscribes to all and reads nothing.
// Counters: percentiles of the pipeline's and of the sink's milliseconds, what the reader got of what was
// sent, and the p99 of the pipeline beside a hanging viewer over that without one. PCL_BV_BENCH_TURNS: of
// each (12, so 600 frames).

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "client.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/frame_sink.h"
#include "pcl_bv/synth/street.h"
#include "program.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

using Clock = std::chrono::steady_clock;
using test::Client;
using test::Json;
constexpr std::chrono::milliseconds kPeriod{50};
enum Viewer : std::size_t { none, reads, hangs };

struct Times {
  std::vector<double> pipeline, sink;
};

double percentile(std::vector<double>& ms, double share) {
  std::sort(ms.begin(), ms.end());
  return ms.at(static_cast<std::size_t>(share * static_cast<double>(ms.size() - 1)));
}

class Stream {
 public:
  Stream() {
    PipelineConfig config;
    config.volumes = {"aabb", "sphere-exact", "obb-yaw", "dop26"};
    config.track.enabled = true;
    pipeline_.set_config(config);
    sink_ = make_sink(parse_sink("ws:0"));
    const std::string shows = sink_->take_warnings().at(0);
    port_ = static_cast<std::uint16_t>(std::stoul(shows.substr(shows.rfind(':') + 1)));
    StreetOptions street;
    street.points = points_in_this_run(130'000);
    for (std::size_t i = 0; i < 10; ++i)
      clouds_.push_back(make_street_frame(street, i).cloud.xyz);
  }

  std::unique_ptr<Client> connect() const {
    auto client = std::make_unique<Client>(port_);
    client->open();
    const Json channels = client->await("advertise")["channels"];
    Json all = Json::array();
    for (const Json& channel : channels)
      all.push_back({{"id", channel["id"]}, {"channelId", channel["id"]}});
    client->say({{"op", "subscribe"}, {"subscriptions", all}});
    client->say({{"op", "getParameters"}, {"parameterNames", Json::array()}, {"id", "subscribed"}});
    client->await("parameterValues");
    return client;
  }

  void run(std::size_t frames, Times& times) {
    auto due = Clock::now();
    for (std::size_t i = 0; i < frames; ++i, ++sent_) {
      std::this_thread::sleep_until(due += kPeriod);
      const std::vector<float>& xyz = clouds_[sent_ % clouds_.size()];
      Frame frame;
      frame.header = {sent_, static_cast<std::int64_t>(sent_) * 50'000'000, "lidar"};
      frame.points = PointView::of(xyz.data(), 12, xyz.size() / 3);
      pipeline_.process(frame, result_);
      times.pipeline.push_back(result_.ms.total);
      const auto begin = Clock::now();
      sink_->write(frame, result_);
      times.sink.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    }
  }

 private:
  FramePipeline pipeline_;
  FrameResult result_;
  std::unique_ptr<FrameSink> sink_;
  std::uint16_t port_ = 0;
  std::vector<std::vector<float>> clouds_;
  std::uint64_t sent_ = 0;
};

// Frames that come, until there are so many or none comes for 20 s.
std::size_t are_frame_numbers(Client& client, std::size_t wanted) {
  std::size_t count = 0;
  try {
    while (count < wanted)
      count += client.await_message().bytes.compare(13, 9, "{\"schema\"") == 0;
  } catch (const boost::system::system_error&) {
  }
  return count;
}

void beside_viewers(benchmark::State& state) {
  const char* const wanted = std::getenv("PCL_BV_BENCH_TURNS");
  const int turns = times_in_this_run(wanted == nullptr ? 12 : std::atoi(wanted));
  const std::size_t frames = tiny() ? 2 : 50;
  for (auto _ : state) {
    Stream stream;
    std::array<Times, 3> times;
    std::size_t sent = 0, got = 0;
    Times first;
    stream.run(frames, first);
    for (int turn = 0; turn < turns; ++turn) {
      stream.run(frames, times[none]);
      {
        const std::unique_ptr<Client> client = stream.connect();
        std::thread reader([&] { got += are_frame_numbers(*client, frames); });
        stream.run(frames, times[reads]);
        reader.join();
        sent += frames;
      }
      const std::unique_ptr<Client> client = stream.connect();
      stream.run(frames, times[hangs]);
    }
    state.counters["sent"] = static_cast<double>(sent);
    state.counters["received"] = static_cast<double>(got);
    const std::array<const char*, 3> names{"none", "reads", "hangs"};
    for (const Viewer viewer : {none, reads, hangs}) {
      for (const auto& [what, share] : {std::pair("p50", 0.5), std::pair("p99", 0.99)}) {
        state.counters[std::string(names[viewer]) + '_' + what] = percentile(times[viewer].pipeline, share);
        state.counters[std::string(names[viewer]) + "_sink_" + what] = percentile(times[viewer].sink, share);
      }
    }
    state.counters["hangs_over_none_p99"] =
        percentile(times[hangs].pipeline, 0.99) / percentile(times[none].pipeline, 0.99);
  }
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark("live/beside-viewers", pcl_bv::bench::beside_viewers)
      ->Iterations(1)
      ->UseRealTime();
  return pcl_bv::bench::run_program(argc, argv);
}
