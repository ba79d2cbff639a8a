// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Made frames.

#include "pcl_bv/synth/synth.h"
#include "pcl_bv/synth/street.h"
#include "sources.h"

namespace pcl_bv {

std::unique_ptr<FrameSource> open_synth(const std::string& name, const ReplayOptions& options) {
  if (options.from_name) throw std::invalid_argument("'" + name + "' has no names with times");
  const StreetSequenceSpec spec = parse_street_sequence(name.substr(kSynth.size()));
  StreetOptions street;
  street.seed = spec.seed;
  return make_replay(spec.frames, {}, options, [street](std::size_t place, Frame& frame) {
    const auto xyz =
        std::make_shared<std::vector<float>>(std::move(make_street_frame(street, place).cloud.xyz));
    frame.points = PointView::of(xyz->data(), 3 * sizeof(float), xyz->size() / 3);
    frame.owner = xyz;
    if (frame.header.frame_id.empty()) frame.header.frame_id = "street";
  });
}

}  // namespace pcl_bv
