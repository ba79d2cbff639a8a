// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ground_score.h"

#include <algorithm>
#include <limits>
#include <map>

namespace pcl_bv::bench {
namespace {

// GroundScore::bands for ranges beyond the last edge.
std::size_t band_of(double range) {
  const auto after = std::upper_bound(GroundScore::edges.begin(), GroundScore::edges.end(), range);
  const auto band = static_cast<std::size_t>(after - GroundScore::edges.begin()) - 1;
  return std::min(band, GroundScore::bands);
}

double share(std::size_t part, std::size_t rest) {
  return part + rest == 0 ? 1 : static_cast<double>(part) / static_cast<double>(part + rest);
}

}  // namespace

void GroundScore::add(const LabelledSweep& sweep) {
  for (std::size_t i = 0; i < sweep.range.size(); ++i) {
    if (!(sweep.range[i] > 0)) continue;
    const std::size_t band = band_of(sweep.range[i]);
    const bool grass = sweep.vegetation[i] != 0;
    if (band == bands || (grass && vegetation_ == Vegetation::not_counted)) continue;
    const bool ground = grass ? vegetation_ == Vegetation::ground : sweep.ground[i] != 0;
    const bool found = sweep.found[i] != 0;
    if (!ground && !found) continue;
    Counts& counts = !found ? missed_ : ground ? right_ : wrong_;
    ++counts[band];
    ++counts[all];
  }
  add_objects(sweep);
}

void GroundScore::add_objects(const LabelledSweep& sweep) {
  struct Object {
    std::size_t points = 0, found = 0;
    double nearest = std::numeric_limits<double>::infinity();
  };
  std::map<std::uint32_t, Object> objects;
  for (std::size_t i = 0; i < sweep.range.size(); ++i) {
    if (sweep.object[i] == 0) continue;
    Object& object = objects[sweep.object[i]];
    ++object.points;
    object.found += sweep.found[i];
    object.nearest = std::min(object.nearest, sweep.range[i]);
  }
  for (const auto& [id, object] : objects) {
    const std::size_t band = band_of(object.nearest);
    if (object.points < 10 || band == bands) continue;
    const std::size_t gone = 2 * object.found > object.points ? 1 : 0;
    for (const std::size_t place : {band, all}) {
      ++objects_[place];
      lost_[place] += gone;
    }
  }
}

double GroundScore::recall(std::size_t band) const {
  return share(right_[band], missed_[band]);
}

double GroundScore::precision(std::size_t band) const {
  return share(right_[band], wrong_[band]);
}

}  // namespace pcl_bv::bench
