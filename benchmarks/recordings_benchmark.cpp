// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Recordings that are in the page cache, both sides in turns: over-pread/COMPRESSION is reading the file in
// blocks of 1 MiB over reading every message of it; cloud-in-place/n:POINTS is a copy of a message's data
// over viewing its points; packets/PROFILE is reading a capture of an Ouster with 128 beams and 1024 columns
// at 10 Hz in blocks over reading its sweeps, and real_time is the recorded time over the time of reading.

#include <unistd.h>

#include <cstring>
#include <fstream>
#include <stdexcept>

#include "../tests/recording/made_ouster.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/messages/cloud.h"
#include "pcl_bv/messages/schema.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/recording/mcap_writer.h"
#include "pcl_bv/recording/packet_reader.h"
#include "pcl_bv/recording/recording.h"
#include "pcl_bv/synth/street.h"
#include "timing.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

std::vector<std::byte> message_of(std::size_t points, std::size_t frame) {
  StreetOptions options;
  options.points = points;
  const std::vector<float> xyz = make_street_frame(options, frame).cloud.xyz;
  msg::PointCloud2 cloud;
  cloud.width = static_cast<std::uint32_t>(xyz.size() / 3);
  cloud.point_step = 12;
  cloud.row_step = 12 * cloud.width;
  cloud.fields = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}};
  cloud.data = {reinterpret_cast<const std::byte*>(xyz.data()), 4 * xyz.size()};
  std::vector<std::byte> bytes;
  write_cdr(cloud, bytes);
  return bytes;
}

// Gone with the process.
class Recorded {
 public:
  explicit Recorded(Compression compression)
      : path_(std::filesystem::temp_directory_path() /
              ("pcl_bv_bench_" + std::to_string(::getpid()) + ".mcap")) {
    McapWriter writer(path_, {compression, 1U << 20U});
    writer.add_topic({"/points", msg::PointCloud2::ros_type, schema_of(msg::PointCloud2::ros_type), {}});
    const std::size_t points = points_in_this_run(130'000);
    for (std::size_t i = 0; i < 100; ++i) {
      const std::vector<std::byte> message = message_of(points, i % 4);
      writer.write(0, static_cast<std::int64_t>(i), 0, message.data(), message.size());
    }
    writer.close();
  }
  ~Recorded() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void add_reading(const std::string& name, Compression compression) {
  add_turns("over-pread/" + name, 10, [=](benchmark::State& state) {
    const Recorded recorded(compression);
    std::vector<std::byte> block(1U << 20U);
    const auto plain = [&] {
      const InputFile file(recorded.path());
      for (std::size_t at = 0; at < file.size(); at += block.size())
        file.read(at, block.data(), std::min(block.size(), file.size() - at));
      benchmark::DoNotOptimize(block.data());
    };
    const auto messages = [&] {
      const auto reader = open_recording(recorded.path());
      std::size_t count = 0;
      for (RecordedMessage message; reader->next(message); ++count)
        benchmark::DoNotOptimize(message.data);
      if (count != 100) throw std::logic_error("other messages");
    };
    compare(state, plain, messages);
    state.counters["MB"] = static_cast<double>(std::filesystem::file_size(recorded.path())) / 1e6;
  });
}

// A capture of one second, in fragments as on an Ethernet. Gone with the process.
class Captured {
 public:
  explicit Captured(const std::string& profile)
      : path_(std::filesystem::temp_directory_path() /
              ("pcl_bv_bench_" + std::to_string(::getpid()) + ".pcap")) {
    const MadeOuster sensor = made_ouster(profile, 128, 1024);
    std::vector<std::string> ip;
    for (unsigned frame = 0; frame < 10; ++frame) {
      const std::vector<MadeColumn> columns = random_columns(sensor, 100'000'000 * (frame + 1), frame);
      for (const std::string& packet : packets_of_frame(sensor, frame, columns)) {
        for (const std::string& fragment : fragments_of(udp(packet), identification_++))
          ip.push_back(fragment);
      }
    }
    std::ofstream(path_, std::ios::binary) << pcap_of_ip(ip);
    std::ofstream(metadata()) << nested_metadata(sensor);
  }
  ~Captured() {
    std::filesystem::remove(path_);
    std::filesystem::remove(metadata());
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path metadata() const { return std::filesystem::path(path_).replace_extension(".json"); }

  std::filesystem::path path_;
  unsigned identification_ = 0;
};

void add_packets(const std::string& profile) {
  add_turns("packets/" + profile, 10, [=](benchmark::State& state) {
    const Captured captured(profile);
    std::vector<std::byte> block(1U << 20U);
    const auto plain = [&] {
      const InputFile file(captured.path());
      for (std::size_t at = 0; at < file.size(); at += block.size())
        file.read(at, block.data(), std::min(block.size(), file.size() - at));
      benchmark::DoNotOptimize(block.data());
    };
    const auto sweeps = [&] {
      PacketReader reader(captured.path());
      std::size_t count = 0;
      for (SensorSweep sweep; reader.next(sweep); ++count)
        benchmark::DoNotOptimize(sweep.points.data());
      if (count != 10) throw std::logic_error("other sweeps");
    };
    compare(state, plain, sweeps);
    state.counters["MB"] = static_cast<double>(std::filesystem::file_size(captured.path())) / 1e6;
    state.counters["real_time"] = 1e6 / state.counters["second_us"];
  });
}

void add_view() {
  const std::size_t points = points_in_this_run(130'000);
  add_turns("cloud-in-place/n:130000", kPairs, [=](benchmark::State& state) {
    const std::vector<std::byte> message = message_of(points, 0);
    std::vector<std::byte> copy(message.size());
    compare(
        state,
        [&] {
          std::memcpy(copy.data(), message.data(), message.size());
          benchmark::DoNotOptimize(copy.data());
        },
        [&] {
          msg::PointCloud2 cloud;
          read_cdr(message.data(), message.size(), cloud);
          auto view = view_points(cloud);
          if (!view) throw std::logic_error("no view");
          benchmark::DoNotOptimize(view);
        });
  });
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  using namespace pcl_bv::bench;
  add_reading("none", pcl_bv::detail::Compression::none);
  add_reading("lz4", pcl_bv::detail::Compression::lz4);
  add_reading("zstd", pcl_bv::detail::Compression::zstd);
  add_view();
  for (const char* profile :
       {"LEGACY", "RNG19_RFL8_SIG16_NIR16", "RNG19_RFL8_SIG16_NIR16_DUAL", "RNG15_RFL8_NIR8"})
    add_packets(profile);
  return run_program(argc, argv);
}
