// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Made frames.

#include "pcl_bv/synth/synth.h"
#include "pcl_bv/synth/street.h"
#include "sources.h"

namespace pcl_bv {
namespace {

class SynthSource : public FrameSource {
 public:
  SynthSource(const StreetSequenceSpec& spec, const ReplayOptions& options)
      : spec_(spec), replay_(spec.frames, options) {}

  Next next(Frame& frame, std::chrono::milliseconds) override {
    if (replay_.ended()) return Next::end;
    const auto begin = std::chrono::steady_clock::now();
    StreetOptions options;
    options.seed = spec_.seed;
    const auto xyz = std::make_shared<std::vector<float>>(
        std::move(make_street_frame(options, replay_.place()).cloud.xyz));
    frame = replay_.begin("", "street");
    frame.points = PointView::of(xyz->data(), 3 * sizeof(float), xyz->size() / 3);
    frame.owner = xyz;
    frame.decode_ms = milliseconds_since(begin);
    return Next::frame;
  }

 private:
  StreetSequenceSpec spec_;
  Replay replay_;
};

}  // namespace

std::unique_ptr<FrameSource> open_synth(const std::string& name, const ReplayOptions& options) {
  if (options.from_name) throw std::invalid_argument("'" + name + "' has no names with times");
  return std::make_unique<SynthSource>(parse_street_sequence(name.substr(kSynth.size())), options);
}

}  // namespace pcl_bv
