// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "baseline_tracker.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "pipeline/track/assignment.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

constexpr double kPi = 3.14159265358979323846;

double wrapped(double angle) {  // from -pi to pi
  return std::remainder(angle, 2 * kPi);
}

}  // namespace

double box_iou(const DetectedBox& a, const DetectedBox& b) {
  const double iou = ground_iou(a.base, b.base);
  const double area = iou / (1 + iou) * (a.base.area() + b.base.area());  // of the intersection
  const double shared = area * std::max(0.0, std::min(a.high, b.high) - std::max(a.low, b.low));
  const double all = a.base.area() * (a.high - a.low) + b.base.area() * (b.high - b.low) - shared;
  return all > 0 ? shared / all : 0;
}

BaselineTracker::Measurement BaselineTracker::measurement_of(const DetectedBox& box) {
  Measurement z;
  z << box.base.center, (box.low + box.high) / 2, box.base.yaw, box.base.length, box.base.width,
      box.high - box.low;
  return z;
}

DetectedBox BaselineTracker::box_of(const State& s) {
  return {{s.head<2>(), s[3], s[4], s[5]}, s[2] - s[6] / 2, s[2] + s[6] / 2};
}

// The variances of the first state, the process and the measurement are those of the paper's code: 10 and 10
// 000 for what is and what is not measured, 1 and 0.01, and 1.
BaselineTracker::Track BaselineTracker::start(const DetectedBox& box) {
  Track track;
  track.state.setZero();
  track.state.head<7>() = measurement_of(box);
  track.covariance.setZero();
  track.covariance.diagonal().head<7>().setConstant(10);
  track.covariance.diagonal().tail<3>().setConstant(10'000);
  return track;
}

void BaselineTracker::predict(Track& track) {
  Eigen::Matrix<double, 10, 10> step = Eigen::Matrix<double, 10, 10>::Identity();
  step.block<3, 3>(0, 7).setIdentity();
  track.state = (step * track.state).eval();
  track.state[3] = wrapped(track.state[3]);
  track.covariance = (step * track.covariance * step.transpose()).eval();
  track.covariance.diagonal().head<7>().array() += 1;
  track.covariance.diagonal().tail<3>().array() += 0.01;
}

void BaselineTracker::correct(Track& track, const DetectedBox& box) {
  Measurement innovation = measurement_of(box) - track.state.head<7>();
  innovation[3] = wrapped(innovation[3]);
  // A detector confuses front and back; the yaw of the track follows the detection then.
  if (std::abs(innovation[3]) > kPi / 2) {
    track.state[3] = wrapped(track.state[3] + kPi);
    innovation[3] = wrapped(innovation[3] + kPi);
  }
  const Eigen::Matrix<double, 7, 7> variance =
      track.covariance.topLeftCorner<7, 7>() + Eigen::Matrix<double, 7, 7>::Identity();
  const Eigen::Matrix<double, 10, 7> gain = track.covariance.leftCols<7>() * variance.inverse();
  track.state += gain * innovation;
  track.state[3] = wrapped(track.state[3]);
  track.covariance -= (gain * track.covariance.topRows<7>()).eval();
}

std::vector<std::optional<std::uint32_t>> BaselineTracker::update(
    const std::vector<DetectedBox>& detections) {
  std::vector<AssignmentPair> pairs;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    predict(tracks_[t]);
    const DetectedBox expected = box_of(tracks_[t].state);
    for (std::size_t d = 0; d < detections.size(); ++d) {
      const double iou = box_iou(expected, detections[d]);
      if (iou >= options_.min_iou) pairs.push_back({t, d, 1 - iou});
    }
  }
  SparseAssignment assignment;
  assignment.solve(tracks_.size(), detections.size(), pairs, 1);
  std::vector<std::optional<std::uint32_t>> ids(detections.size());
  std::vector<bool> assigned(detections.size(), false);
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    Track& track = tracks_[t];
    const std::size_t d = assignment.columns()[t];
    if (d >= detections.size()) {
      ++track.missed;
      continue;
    }
    assigned[d] = true;
    correct(track, detections[d]);
    track.missed = 0;
    if (++track.detections >= options_.birth && !track.id) track.id = next_id_++;
    ids[d] = track.id;
  }
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(),
                               [&](const Track& track) { return track.missed >= options_.death; }),
                tracks_.end());
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (assigned[d]) continue;
    tracks_.push_back(start(detections[d]));
    if (options_.birth <= 1) ids[d] = tracks_.back().id = next_id_++;
  }
  return ids;
}

}  // namespace pcl_bv::bench
