// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Kalman filter of position and velocity along three axes (Kalman 1960).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Position and velocity along one axis, metres and m/s, with their covariance.
struct AxisFilter {
  double position = 0, velocity = 0;
  double position_variance = 1, covariance = 0, velocity_variance = 1;

  /// Predicts with a constant velocity and a white-noise acceleration of spectral density `density`
  /// (m^2/s^3). Many small steps give the same result as one large step, so stamps a millisecond apart do no
  /// harm.
  void predict(double seconds, double density) {
    position += seconds * velocity;
    position_variance += seconds * (2 * covariance + seconds * (velocity_variance + seconds * density / 3));
    covariance += seconds * (velocity_variance + seconds * density / 2);
    velocity_variance += seconds * density;
  }

  /// Updates the state by a measurement with this variance. `innovation` is the measured minus the predicted
  /// position. The position variance is computed in the Joseph form, a sum of squares, which rounding cannot
  /// make negative.
  void correct(double innovation, double variance) {
    const double all = position_variance + variance;
    const double position_gain = position_variance / all, velocity_gain = covariance / all,
                 left = variance / all;
    position += position_gain * innovation;
    velocity += velocity_gain * innovation;
    const double old_variance = position_variance, old_covariance = covariance;
    position_variance = left * left * old_variance + position_gain * position_gain * variance;
    covariance =
        left * (old_covariance - velocity_gain * old_variance) + position_gain * velocity_gain * variance;
    velocity_variance += velocity_gain * (velocity_gain * all - 2 * old_covariance);
    // A lower bound keeps the covariance matrix positive definite.
    velocity_variance =
        std::max(velocity_variance, (1 + 1e-9) * covariance * covariance / position_variance + 1e-12);
  }

  /// Pulls the velocity towards zero, like a measurement of zero with this standard deviation (m/s). The
  /// variance stays, because nothing was measured.
  void slow_down(double deviation) {
    velocity *= deviation * deviation / (deviation * deviation + velocity_variance);
  }

  /// Sets position and velocity from the first two measurements, without a prior. Must be called for the
  /// second measurement. Both measurements have this variance and are `seconds` apart.
  void start(double innovation, double variance, double seconds) {
    position += innovation;
    velocity += innovation / seconds;
    position_variance = variance;
    covariance = variance / seconds;
    velocity_variance = 2 * variance / (seconds * seconds);
  }
};

/// Three independent filters, one for each axis.
struct MotionFilter {
  std::array<AxisFilter, 3> axes;

  Eigen::Vector3d position() const { return {axes[0].position, axes[1].position, axes[2].position}; }
  Eigen::Vector3d velocity() const { return {axes[0].velocity, axes[1].velocity, axes[2].velocity}; }
  Eigen::Vector3d position_variance() const {
    return {axes[0].position_variance, axes[1].position_variance, axes[2].position_variance};
  }
  Eigen::Vector3d velocity_variance() const {
    return {axes[0].velocity_variance, axes[1].velocity_variance, axes[2].velocity_variance};
  }
  Eigen::Vector3d covariance() const { return {axes[0].covariance, axes[1].covariance, axes[2].covariance}; }
  void predict(double seconds, double density) {
    for (AxisFilter& axis : axes)
      axis.predict(seconds, density);
  }
  void limit_speed(double max_speed) {
    const double speed = velocity().norm();
    if (!(speed > max_speed)) return;
    for (AxisFilter& axis : axes)
      axis.velocity *= max_speed / speed;
  }
};

}  // namespace detail
}  // namespace pcl_bv
