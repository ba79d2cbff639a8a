// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The directions and firing times of a Hesai sensor's channels.
#pragma once

#include <optional>
#include <vector>

#include "hesai_mirrors.h"
#include "hesai_model.h"
#include "packet_numbers.h"
#include "sensor_point.h"

namespace pcl_bv::detail {

/// A direction in metres for each unit of distance.
struct HesaiDirection {
  Double2 xy;
  double z;
};

/// The content of a correction file: the angles of the channels or, for an AT128, its mirrors.
struct HesaiCorrection {
  std::vector<HesaiAngles> angles{};
  std::optional<HesaiMirrors> mirrors{};

  bool is_empty() const { return angles.empty() && !mirrors; }
  bool is_for(const HesaiModel& model) const {
    return model.has_mirrors ? mirrors.has_value() : angles.size() == model.channels;
  }
};

/// The geometry of a sensor. A distance d at the rotor's azimuth a gives the point
/// d * (y sin a + x cos a, y cos a - x sin a, z): y is at azimuth 0, x at azimuth 90 degrees.
struct HesaiGeometry {
  HesaiGeometry(const HesaiModel& sensor, const HesaiCorrection& correction);

  const HesaiModel* model;
  std::vector<double> x, y, z;  // direction of each channel at azimuth 0, metres for each unit
  // Number of each channel and, in the upper half, its time after the beginning of its firing, nanoseconds.
  std::vector<std::uint64_t> rings_and_times;
  std::optional<HesaiMirrors> mirrors;  // only of an AT128, which has no x, y and z

  /// Returns the number of the frame at an azimuth (hundredths of a degree) plus whole revolutions: of the
  /// revolution or, for an AT128, of the rotation of one mirror.
  long long frame_at(double unwrapped) const;
  /// Computes the direction of each channel of an AT128.
  void mirror(double azimuth, std::vector<HesaiDirection>& directions) const;
};

}  // namespace pcl_bv::detail
