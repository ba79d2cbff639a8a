// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A source of frames that can be loaded again by their index.

#include <algorithm>
#include <chrono>
#include <utility>

#include "pcl_bv/io/untrusted_text.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

class Replay : public FrameSource {
 public:
  Replay(std::size_t length, std::vector<std::filesystem::path> files, const ReplayOptions& options,
         std::function<void(std::size_t, Frame&)> load, NameTimes times)
      : length_(length),
        files_(std::move(files)),
        options_(options),
        load_(std::move(load)),
        times_(std::move(times)),
        end_(options.loops < SIZE_MAX / length ? length * std::max<std::size_t>(options.loops, 1)
                                               : SIZE_MAX) {
    if (!times_.warning.empty()) warnings_.push_back(std::move(times_.warning));
    if (options.poses.empty()) return;
    std::vector<std::string> stems;
    for (const std::filesystem::path& file : files_)
      stems.push_back(file.stem().string());
    poses_ = Poses(options.poses, length, numbers_of_names(stems));
    if (!poses_.note().empty()) warnings_.push_back(poses_.note());
  }

  Next next(Frame& frame, std::chrono::milliseconds) override {
    if (seq_ == end_) return Next::end;
    const std::size_t index = seq_ % length_;
    frame = named(index);
    ++seq_;
    const auto begin = std::chrono::steady_clock::now();
    try {
      if (frame.header.stamp_ns < 0) throw std::runtime_error("no time in its name");
      load_(index, frame);
    } catch (const std::exception& error) {
      throw FrameError(std::move(frame), reason_of(error));
    }
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    frame.decode_ms = took.count();
    return Next::frame;
  }

  std::vector<std::string> take_warnings() override { return std::exchange(warnings_, {}); }

 private:
  Frame named(std::size_t index) const {
    Frame frame;
    if (!files_.empty()) frame.file = files_[index].string();
    frame.header.seq = seq_;
    frame.pass = seq_ / length_;
    frame.header.frame_id = options_.frame_id;
    const std::int64_t own = options_.own_stamps ? times_.stamps[index] : 0;
    frame.header.stamp_ns = replay_stamp(options_, own, seq_);
    frame.pose = poses_.at(index, replay_stamp(options_, own, index));
    return frame;
  }

  std::size_t length_;
  std::vector<std::filesystem::path> files_;
  ReplayOptions options_;
  std::function<void(std::size_t, Frame&)> load_;
  NameTimes times_;
  std::uint64_t end_, seq_ = 0;
  Poses poses_;
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<FrameSource> make_replay(std::size_t length, std::vector<std::filesystem::path> files,
                                         const ReplayOptions& options,
                                         std::function<void(std::size_t, Frame&)> load, NameTimes times) {
  return std::make_unique<Replay>(length, std::move(files), options, std::move(load), std::move(times));
}

}  // namespace pcl_bv::detail
