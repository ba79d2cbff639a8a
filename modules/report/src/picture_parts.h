// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a picture is put together from.
#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "palette.h"
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

/// The view that frames what picture_png() promises.
View fit_view(const Picture& picture);

/// A sample of the drawn points that matter for the frame: those in clusters if there are labels, else all.
std::vector<Eigen::Vector3d> framed_points(const Picture& picture);

/// Rows of width x height pixels 0xffRRGGBB: the background and, nearest first, the points.
std::vector<std::uint32_t> draw_points(const Picture& picture, const View& view);

/// Draws the axes that are not seen end-on and a scale bar, in the lower left corner. Nothing in pictures too
/// small for them, below 480 x 320.
void draw_marks(cairo_t* cairo, const View& view);

}  // namespace pcl_bv
