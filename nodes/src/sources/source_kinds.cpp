// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table of sources, and what all recordings share.

#include <algorithm>
#include <cmath>

#include "sources.h"

namespace pcl_bv {

const std::vector<SourceKind>& source_kinds() {
  static const std::vector<SourceKind> kinds{
      {"synth:street-sequence[:FRAMES[:SEED]]", false,
       [](const std::string& name) { return name.starts_with(kSynth); }, open_synth},
      {"a folder of clouds, one file", true, [](const std::string&) { return true; }, open_folder}};
  return kinds;
}

const SourceKind& source_kind(const std::string& name) {
  return *std::find_if(source_kinds().begin(), source_kinds().end() - 1,
                       [&](const SourceKind& kind) { return kind.takes(name); });
}

std::string source_syntax() {
  std::string all;
  for (auto kind = source_kinds().rbegin(); kind != source_kinds().rend(); ++kind)
    all += (all.empty() ? "" : " or ") + std::string(kind->syntax);
  return all;
}

std::unique_ptr<FrameSource> open_source(const std::string& name, const ReplayOptions& options) {
  if (!(options.rate_hz >= kLeastRate && options.rate_hz <= kGreatestRate))
    throw std::invalid_argument("rate: is not a number from 0.001 to 1000000");
  return source_kind(name).open(name, options);
}

Replay::Replay(std::size_t length, const ReplayOptions& options)
    : options_(options),
      length_(length),
      end_(options.loops < SIZE_MAX / length ? length * std::max<std::size_t>(options.loops, 1) : SIZE_MAX) {
  if (!options.poses.empty()) poses_ = Poses(options.poses, length);
}

Frame Replay::begin(std::string file, std::string_view frame_id) {
  Frame frame;
  frame.header.seq = seq_;
  frame.header.stamp_ns = options_.from_name
                              ? stamp_in_name(std::filesystem::path(file).stem().string())
                              : std::llround(1e9 * static_cast<double>(seq_) / options_.rate_hz);
  frame.header.frame_id = options_.frame_id.empty() ? frame_id : options_.frame_id;
  frame.pose = poses_.at(place(), frame.header.stamp_ns);
  frame.file = std::move(file);
  ++seq_;
  if (options_.from_name && frame.header.stamp_ns < 0)
    throw FrameError(std::move(frame), "no time in its name");
  return frame;
}

}  // namespace pcl_bv
