// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Recordings that are in the page cache, both sides in turns: over-pread/COMPRESSION is reading the file in
// blocks of 1 MiB over reading every message of it; cloud-in-place/n:POINTS is a copy of a message's data
// over viewing its points.

#include <unistd.h>

#include <cstring>
#include <stdexcept>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/messages/cloud.h"
#include "pcl_bv/messages/schema.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/recording/mcap_writer.h"
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
  return run_program(argc, argv);
}
