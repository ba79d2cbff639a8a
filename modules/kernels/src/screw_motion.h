// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>

#include "pcl_bv/kernels/deskew.h"

namespace pcl_bv::detail {

/// The constants of a SensorMotion with velocity v and rotation w, in the scalar type of the points.
///
/// exp(t * motion) p = p + A w x p + B (w x (w x p) + w x v) + (t v + C w x (w x v)), where with
/// s = |w|^2 t^2 the factors are A = sin(sqrt(s)) / |w|, B = (1 - cos(sqrt(s))) / |w|^2 and
/// C = (t - A) / |w|^2. They are computed by series of four terms.
template <typename T>
struct ScrewMotion {
  std::array<T, 3> v{}, w{}, wv{}, wwv{};  ///< `wv` is w x v, `wwv` is w x (w x v).
  T ww = 0;                                ///< |w|^2

  explicit ScrewMotion(const SensorMotion& motion) {
    const auto cross = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
      return std::array{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const std::array<double, 3> once = cross(motion.angular_velocity, motion.velocity),
                                twice = cross(motion.angular_velocity, once);
    double squares = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] = static_cast<T>(motion.velocity[i]);
      w[i] = static_cast<T>(motion.angular_velocity[i]);
      wv[i] = static_cast<T>(once[i]);
      wwv[i] = static_cast<T>(twice[i]);
      squares += motion.angular_velocity[i] * motion.angular_velocity[i];
    }
    ww = static_cast<T>(squares);
  }
};

/// Coefficients of the series in s of A / t, B / t^2 and C / t^3.
inline constexpr std::array<std::array<double, 4>, 3> kScrewSeries{
    {{1, -1.0 / 6, 1.0 / 120, -1.0 / 5040},
     {1.0 / 2, -1.0 / 24, 1.0 / 720, -1.0 / 40320},
     {1.0 / 6, -1.0 / 120, 1.0 / 5040, -1.0 / 362880}}};

}  // namespace pcl_bv::detail
