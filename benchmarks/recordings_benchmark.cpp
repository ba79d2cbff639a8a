// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Recordings that are in the page cache, both sides in turns: over-pread/COMPRESSION is reading the file in
// blocks of 1 MiB over reading every message of it; cloud-in-place/n:POINTS is a copy of a message's data
// over viewing its points; packets/PROFILE is reading a capture of an Ouster with 128 beams and 1024 columns
// at 10 Hz in blocks over reading its sweeps, and real_time is the recorded time over the time of reading.
// packets/MODEL is the same for Hesai's and Livox' sensors.

#include <unistd.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <stdexcept>

#include "../tests/recording/made_hesai.h"
#include "../tests/recording/made_livox.h"
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

// A capture of one second and the file that its decoder needs.
struct Capture {
  std::string packets, metadata;
  const char* extension;  // of the metadata's file
  std::size_t sweeps;
};

// In fragments as on an Ethernet.
Capture ouster_capture(const std::string& profile) {
  const MadeOuster sensor = made_ouster(profile, 128, 1024);
  std::vector<std::string> ip;
  unsigned identification = 0;
  for (unsigned frame = 0; frame < 10; ++frame) {
    const std::vector<MadeColumn> columns = random_columns(sensor, 100'000'000 * (frame + 1), frame);
    for (const std::string& packet : packets_of_frame(sensor, frame, columns)) {
      for (const std::string& fragment : fragments_of(udp(packet), identification++))
        ip.push_back(fragment);
    }
  }
  return {pcap_of_ip(ip), nested_metadata(sensor), ".json", 10};
}

// At 10 Hz.
Capture hesai_capture(std::size_t channels, bool dual) {
  MadeHesai sensor{channels, dual};
  sensor.step = sensor.xt() ? 18 : 20;
  const auto number = static_cast<std::size_t>(1e6 / sensor.period_us()) / sensor.firings();
  std::vector<std::string> packets;
  for (const MadeHesaiPacket& packet : hesai_packets(sensor, number, 0, 1, 0))
    packets.push_back(hesai_bytes(sensor, packet));
  return {pcap(packets), hesai_correction(channels), ".csv", 10};
}

// A HAP measures 452 000 points in a second.
Capture livox_capture(unsigned type) {
  std::vector<std::string> packets;
  for (unsigned i = 0; i < 4'708; ++i)
    packets.push_back(livox_packet(random_livox(type, 212'400U * std::uint64_t{i}, i)));
  return {pcap(packets), "", ".json", 10};
}

// Gone with the process.
class Captured {
 public:
  explicit Captured(const Capture& capture)
      : path_(std::filesystem::temp_directory_path() /
              ("pcl_bv_bench_" + std::to_string(::getpid()) + ".pcap")),
        metadata_(std::filesystem::path(path_).replace_extension(capture.extension)) {
    std::ofstream(path_, std::ios::binary) << capture.packets;
    std::ofstream(metadata_) << capture.metadata;
  }
  ~Captured() {
    std::filesystem::remove(path_);
    std::filesystem::remove(metadata_);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_, metadata_;
};

void add_packets(const std::string& name, const std::function<Capture()>& make) {
  add_turns("packets/" + name, 10, [=](benchmark::State& state) {
    const Capture capture = make();
    const Captured captured(capture);
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
      if (count != capture.sweeps) throw std::logic_error("other sweeps");
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
    add_packets(profile, [=] { return ouster_capture(profile); });
  add_packets("PandarXT-32", [] { return hesai_capture(32, false); });
  add_packets("PandarXT-32-dual", [] { return hesai_capture(32, true); });
  add_packets("Pandar64", [] { return hesai_capture(64, false); });
  add_packets("Pandar64-dual", [] { return hesai_capture(64, true); });
  add_packets("Livox-HAP", [] { return livox_capture(1); });
  add_packets("Livox-HAP-spherical", [] { return livox_capture(3); });
  return run_program(argc, argv);
}
