// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Recorded and made frames.

#include "pcl_bv/nodes/frame_source.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/list_clouds.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/synth/street.h"
#include "pcl_bv/synth/synth.h"

namespace pcl_bv {
namespace {

void require_rate(const ReplayOptions& stamps) {
  if (!(stamps.rate_hz >= kLeastRate && stamps.rate_hz <= kGreatestRate))
    throw std::invalid_argument("rate: is not a number from 0.001 to 1000000");
}

std::int64_t stamp_at(std::uint64_t seq, const ReplayOptions& stamps) {
  return std::llround(1e9 * static_cast<double>(seq) / stamps.rate_hz);
}

// Where a source is in what it repeats.
class Loop {
 public:
  Loop(std::size_t length, std::size_t loops)
      : length_(length),
        end_(loops < SIZE_MAX / length ? length * std::max<std::size_t>(loops, 1) : SIZE_MAX) {}
  bool ended() const { return seq_ == end_; }
  std::uint64_t seq() const { return seq_; }
  std::size_t place() const { return seq_ % length_; }
  void advance() { ++seq_; }

 private:
  std::size_t length_;
  std::uint64_t end_, seq_ = 0;
};

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

class FolderSource : public FrameSource {
 public:
  FolderSource(std::vector<std::filesystem::path> files, const ReplayOptions& stamps, std::size_t loops)
      : files_(std::move(files)), stamps_(stamps), loop_(files_.size(), loops) {}

  bool next(Frame& frame) override {
    if (loop_.ended()) return false;
    const std::filesystem::path& file = files_[loop_.place()];
    FrameHeader header{loop_.seq(), stamp_at(loop_.seq(), stamps_), ""};
    loop_.advance();
    if (stamps_.from_name) header.stamp_ns = stamp_in_name(file.stem().string());
    if (stamps_.from_name && header.stamp_ns < 0)
      throw FrameError(header, file.string() + ": no time stamp in its name");
    const auto begin = std::chrono::steady_clock::now();
    try {
      const auto cloud = std::make_shared<RawCloud>(read_cloud(file, Serial{}, stamps_.bin_fields));
      frame = {header, cloud->xyz(), cloud, milliseconds_since(begin)};
      return true;
    } catch (const std::exception& error) {
      throw FrameError(header, file.string() + ": " + error.what());
    }
  }

 private:
  std::vector<std::filesystem::path> files_;
  ReplayOptions stamps_;
  Loop loop_;
};

class SynthSource : public FrameSource {
 public:
  SynthSource(const StreetSequenceSpec& spec, const ReplayOptions& stamps, std::size_t loops)
      : spec_(spec), stamps_(stamps), loop_(spec.frames, loops) {}

  bool next(Frame& frame) override {
    if (loop_.ended()) return false;
    const auto begin = std::chrono::steady_clock::now();
    StreetOptions options;
    options.seed = spec_.seed;
    StreetFrame street = make_street_frame(options, loop_.place());
    const auto xyz = std::make_shared<std::vector<float>>(std::move(street.cloud.xyz));
    const PointView points = PointView::of(xyz->data(), 3 * sizeof(float), xyz->size() / 3);
    frame = {{loop_.seq(), stamp_at(loop_.seq(), stamps_), "street"}, points, xyz, milliseconds_since(begin)};
    loop_.advance();
    return true;
  }

 private:
  StreetSequenceSpec spec_;
  ReplayOptions stamps_;
  Loop loop_;
};

class FunctionSource : public FrameSource {
 public:
  explicit FunctionSource(std::function<bool(Frame&)> next) : next_(std::move(next)) {}
  bool next(Frame& frame) override { return next_(frame); }

 private:
  std::function<bool(Frame&)> next_;
};

}  // namespace

std::unique_ptr<FrameSource> open_folder(const std::filesystem::path& path, const ReplayOptions& stamps,
                                         std::size_t loops) {
  require_rate(stamps);
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown)) throw IoError(path.string() + ": no such file or folder");
  std::vector<std::filesystem::path> files{path};
  if (std::filesystem::is_directory(path, unknown)) files = list_clouds(path);
  if (files.empty()) throw IoError(path.string() + ": no cloud in this folder");
  return std::make_unique<FolderSource>(std::move(files), stamps, loops);
}

std::unique_ptr<FrameSource> open_synth(std::string_view name, const ReplayOptions& stamps, std::size_t loops) {
  require_rate(stamps);
  return std::make_unique<SynthSource>(parse_street_sequence(name), stamps, loops);
}

std::unique_ptr<FrameSource> open_source(const std::string& name, const ReplayOptions& stamps,
                                         std::size_t loops) {
  constexpr std::string_view synth = "synth:";
  if (name.compare(0, synth.size(), synth) == 0) return open_synth(name.substr(synth.size()), stamps, loops);
  return open_folder(name, stamps, loops);
}

std::unique_ptr<FrameSource> make_source(std::function<bool(Frame&)> next) {
  return std::make_unique<FunctionSource>(std::move(next));
}

}  // namespace pcl_bv
