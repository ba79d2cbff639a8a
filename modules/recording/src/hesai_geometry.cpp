// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hesai_geometry.h"

#include <cmath>

namespace pcl_bv::detail {
namespace {

constexpr double kHesaiDegree = 3.14159265358979323846 / 180;
double metres_per_unit(const HesaiModel& model) {
  return model.unit_mm / 1000.0;
}

}  // namespace

HesaiGeometry::HesaiGeometry(const HesaiModel& sensor, const HesaiCorrection& correction)
    : model(&sensor), mirrors(sensor.has_mirrors ? correction.mirrors : std::nullopt) {
  const double unit = metres_per_unit(sensor);
  if (!sensor.has_mirrors) {
    for (const HesaiAngles& channel : correction.angles) {
      const double elevation = channel.elevation * kHesaiDegree, azimuth = channel.azimuth * kHesaiDegree;
      x.push_back(unit * std::cos(elevation) * std::sin(azimuth));
      y.push_back(unit * std::cos(elevation) * std::cos(azimuth));
      z.push_back(unit * std::sin(elevation));
    }
  }
  for (const std::int64_t time_ns : hesai_firing_times(sensor))
    rings_and_times.push_back(rings_and_times.size() | static_cast<std::uint64_t>(time_ns) << 32U);
}

long long HesaiGeometry::frame_at(double unwrapped) const {
  if (mirrors) return mirrors->frame_at(unwrapped);
  return static_cast<long long>(std::floor(unwrapped / static_cast<double>(kFullCircle)));
}

void HesaiGeometry::mirror(double azimuth, std::vector<HesaiDirection>& directions) const {
  constexpr double step = 200;  // hundredths of a degree between the corrections
  const HesaiMirrors& m = *mirrors;
  const double unit = metres_per_unit(*model);
  const std::size_t before = static_cast<std::size_t>(azimuth / step) % HesaiMirrors::kSteps;
  const std::size_t after = (before + 1) % HesaiMirrors::kSteps;
  const double part = azimuth / step - std::floor(azimuth / step);
  const double deflected = 2 * (azimuth - m.start_of(azimuth));
  directions.resize(model->channels);
  for (std::size_t i = 0; i < model->channels; ++i) {
    const std::size_t row = i * HesaiMirrors::kSteps;
    const auto corrected = [&](const std::vector<double>& table) {
      return (1 - part) * table[row + before] + part * table[row + after];
    };
    const auto [sine, cosine] = sine_cosine_of(deflected - m.azimuths[i] + corrected(m.azimuth_corrections));
    const auto [up, level] = sine_cosine_of(m.elevations[i] + corrected(m.elevation_corrections));
    const double metres = unit * level;
    directions[i] = {Double2{metres * sine, metres * cosine}, unit * up};
  }
}

}  // namespace pcl_bv::detail
