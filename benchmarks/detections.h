// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Detections with a known source: the boxes of synth:rural-road-sequence with noise, misses and false alarms.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <unordered_map>
#include <vector>

#include "baseline_tracker.h"
#include "pcl_bv/synth/rural_road.h"

namespace pcl_bv::bench {

/// Errors of a detector. The defaults are of the size that detectors of boxes have on KITTI.
struct DetectorErrors {
  double position = 0.15;   ///< Standard deviation of x, y and z, metres.
  double size = 0.05;       ///< Standard deviation of the sides, as a fraction of them.
  double yaw = 5;           ///< Standard deviation, degrees.
  double miss = 0.1;        ///< Probability that an object is missed in one frame alone.
  double gap = 0.02;        ///< Probability that an object is missed for 2 to 5 frames from now on.
  double false_alarms = 3;  ///< Mean number a frame, anywhere within `range`.
  double range = 50;        ///< Range of the detector, metres.
};

struct Detection {
  DetectedBox box;                      ///< In the sensor's frame.
  std::optional<std::uint32_t> object;  ///< The source; nullopt for a false alarm.
};

/// Makes the detections of one sequence, frame after frame.
class Detector {
 public:
  Detector(const DetectorErrors& errors, std::uint64_t seed) : errors_(errors), random_(seed) {}

  /// Returns the detections of these objects, in a random order.
  std::vector<Detection> detect(const std::vector<RuralRoadObject>& objects);

 private:
  double uniform();  // from 0 to 1
  double normal();   // mean 0, variance 1

  bool is_missed(std::uint32_t object);
  DetectedBox noisy(const RuralRoadObject& object);
  DetectedBox false_alarm();

  DetectorErrors errors_;
  std::mt19937_64 random_;
  std::unordered_map<std::uint32_t, int> gaps_;  // frames for which an object is still missed
};

}  // namespace pcl_bv::bench
