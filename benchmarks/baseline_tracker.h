// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A usual tracker of boxes to compare with: a Kalman filter and the Hungarian method on the IoU of boxes.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "ground_box.h"

namespace pcl_bv::bench {

/// A detected upright box, metres.
struct DetectedBox {
  GroundBox base;
  double low = 0, high = 0;  ///< z
};

/// Returns the IoU of two upright boxes in space; 0 for boxes without volume.
double box_iou(const DetectedBox& a, const DetectedBox& b);

/// Written from the description of AB3DMOT (Weng et al. 2020): the state is x, y, z, yaw, length, width,
/// height and the velocity; the velocity is constant; detections and predicted boxes are assigned at maximum
/// sum of IoU.
class BaselineTracker {
 public:
  struct Options {
    std::size_t birth = 3;  ///< Detections after which a track gets its id.
    std::size_t death = 2;  ///< Frames without a detection after which a track is deleted.
    double min_iou = 0.01;  ///< Smallest IoU of an assignment.
  };

  explicit BaselineTracker(const Options& options) : options_(options) {}

  /// Returns the id of each detection, if its track has one. Frames are equally spaced in time.
  std::vector<std::optional<std::uint32_t>> update(const std::vector<DetectedBox>& detections);

 private:
  using State = Eigen::Matrix<double, 10, 1>;
  using Measurement = Eigen::Matrix<double, 7, 1>;
  struct Track {
    State state;
    Eigen::Matrix<double, 10, 10> covariance;
    std::size_t detections = 1, missed = 0;
    std::optional<std::uint32_t> id;
  };

  static Measurement measurement_of(const DetectedBox& box);
  static DetectedBox box_of(const State& state);
  static Track start(const DetectedBox& box);
  static void predict(Track& track);
  static void correct(Track& track, const DetectedBox& box);

  Options options_;
  std::vector<Track> tracks_;
  std::uint32_t next_id_ = 0;
};

}  // namespace pcl_bv::bench
