// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table of sources.

#include <algorithm>

#include "sources.h"

namespace pcl_bv {

const std::vector<SourceKind>& source_kinds() {
  static const std::vector<SourceKind> kinds{
      {"synth:street-sequence[:FRAMES[:SEED]]", false,
       [](const std::string& name) { return name.starts_with(kSynth); }, open_synth},
      {"A folder of clouds, one file", true, [](const std::string&) { return true; }, open_folder}};
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

}  // namespace pcl_bv
