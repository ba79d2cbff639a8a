// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "detections.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_bv::bench {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

}  // namespace

// The distributions of the standard library differ between libraries, so seeds would not give the same
// figures.
double Detector::uniform() {
  return static_cast<double>(random_() >> 11) * 0x1p-53;
}
double Detector::normal() {
  double sum = -6;  // of twelve uniform numbers: mean 6, variance 1
  for (int i = 0; i < 12; ++i)
    sum += uniform();
  return sum;
}

bool Detector::is_missed(std::uint32_t object) {
  int& gap = gaps_[object];
  if (gap > 0) {
    --gap;
    return true;
  }
  if (uniform() < errors_.gap) {
    gap = 1 + static_cast<int>(4 * uniform());
    return true;
  }
  return uniform() < errors_.miss;
}

DetectedBox Detector::noisy(const RuralRoadObject& object) {
  const auto side = [&](std::size_t axis) {
    return 2 * object.half_extents[axis] * std::max(0.1, 1 + errors_.size * normal());
  };
  DetectedBox box;
  box.base.center = {object.center[0] + errors_.position * normal(),
                     object.center[1] + errors_.position * normal()};
  box.base.yaw = std::atan2(object.axes[0][1], object.axes[0][0]) + errors_.yaw * kDegree * normal();
  box.base.length = side(0);
  box.base.width = side(1);
  const double z = object.center[2] + errors_.position * normal(), height = side(2);
  box.low = z - height / 2;
  box.high = z + height / 2;
  return box;
}

DetectedBox Detector::false_alarm() {
  const double range = errors_.range * std::sqrt(uniform()), angle = 360 * kDegree * uniform();
  DetectedBox box;
  box.base.center = {range * std::cos(angle), range * std::sin(angle)};
  box.base.yaw = 360 * kDegree * uniform();
  box.base.length = 0.4 + 4 * uniform();
  box.base.width = 0.3 + 1.5 * uniform();
  box.low = -1.7;
  box.high = box.low + 0.5 + 1.5 * uniform();
  return box;
}

std::vector<Detection> Detector::detect(const std::vector<RuralRoadObject>& objects) {
  std::vector<Detection> detections;
  for (const RuralRoadObject& object : objects) {
    if (!is_missed(object.id)) detections.push_back({noisy(object), object.id});
  }
  // A number with this mean and the variance of a uniform one is enough: 0 to twice the mean.
  const auto alarms = static_cast<int>(uniform() * (2 * errors_.false_alarms + 1));
  for (int i = 0; i < alarms; ++i)
    detections.push_back({false_alarm(), std::nullopt});
  for (std::size_t i = detections.size(); i > 1; --i)
    std::swap(detections[i - 1], detections[static_cast<std::size_t>(uniform() * static_cast<double>(i))]);
  return detections;
}

}  // namespace pcl_bv::bench
