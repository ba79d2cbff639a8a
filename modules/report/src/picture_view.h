// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where the picture is taken from: world coordinates to pixels.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/report/picture.h"

namespace pcl_bv {

/// A parallel projection. Pixels count from the upper left corner; depth grows away from the viewer and is in
/// pixels too, so that a cube looks like one.
struct View {
  Eigen::Vector3d right, up, toward;  ///< Orthonormal; `toward` points from the scene to the viewer.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;  ///< Pixels per unit.
  int width = 0;
  int height = 0;
  bool empty = true;  ///< Whether there is nothing to see.

  /// Pixel x, pixel y, depth.
  Eigen::Vector3d project(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d d = (p - center) * scale;
    return {width / 2.0 + d.dot(right), height / 2.0 - d.dot(up), -d.dot(toward)};
  }
};

/// Whether the picture shows this point at all.
inline bool is_drawn(const Coordinates& p) {
  return is_valid(p) && (p.x != 0 || p.y != 0 || p.z != 0);
}

/// A hundred thousand points, every so many of them, stand for any number.
inline std::size_t sample_step(const PointView& points) {
  return points.count / 100000 + 1;
}

/// The view that frames what picture_png() promises.
View fit_view(const Picture& picture);

}  // namespace pcl_bv
