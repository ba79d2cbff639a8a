// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A source of frames from sensors' packets, one frame for each revolution.

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/recording/packet_reader.h"
#include "recorded_clouds.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

class Packets final : public FrameSource {
 public:
  Packets(const std::string& name, const ReplayOptions& options)
      : name_(name), options_(options), reader_(name, options.topic) {
    if (!options_.class_field.empty()) throw std::invalid_argument("packets have no field of classes");
    if (!options_.poses.empty()) poses_ = Poses(options_.poses, count());
  }

  Next next(Frame& frame, std::chrono::milliseconds) override {
    const auto begin = std::chrono::steady_clock::now();
    const auto sweep = std::make_shared<SensorSweep>();
    while (!reader_.next(*sweep)) {
      if (++loop_ >= options_.loops || index_ == 0) return Next::end;
      reader_.rewind();
      index_ = 0;
    }
    frame = Frame();
    frame.file = name_;
    frame.header.seq = seq_;
    frame.pass = loop_;
    frame.header.stamp_ns = replay_stamp(options_, sweep->stamp_ns, seq_);
    frame.recorded_ns = sweep->stamp_ns;  // the time of the machine that captured the packets
    frame.header.frame_id = options_.frame_id.empty() ? std::string(sweep->frame_id) : options_.frame_id;
    frame.pose = poses_.at(index_, replay_stamp(options_, sweep->stamp_ns, index_));
    ++index_;
    ++seq_;
    if (!sweep->points.empty()) {
      const SensorPoint& first = sweep->points.front();
      frame.points = PointView::of(&first.x, sizeof(SensorPoint), sweep->points.size());
      frame.intensity = FieldView{reinterpret_cast<const std::byte*>(&first.intensity), sizeof(SensorPoint)};
      frame.times =
          FieldView{reinterpret_cast<const std::byte*>(&first.time_ns), sizeof(SensorPoint), 'U', 4};
    }
    frame.owner = sweep;
    frame.decode_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return Next::frame;
  }

  std::vector<std::string> take_warnings() override {
    return take_new(reader_.warning_lines(), warnings_taken_);
  }

 private:
  std::size_t count() {
    std::size_t sweeps = 0;
    for (SensorSweep sweep; reader_.next(sweep);)
      ++sweeps;
    reader_.rewind();
    return sweeps;
  }

  std::string name_;
  ReplayOptions options_;
  PacketReader reader_;
  Poses poses_;
  std::uint64_t seq_ = 0;
  std::size_t index_ = 0, loop_ = 0, warnings_taken_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> open_packets(const std::string& name, const ReplayOptions& options) {
  try {
    return std::make_unique<Packets>(name, options);
  } catch (const IoError& error) {
    throw IoError(name + ": " + error.what());
  }
}

}  // namespace pcl_bv::detail
