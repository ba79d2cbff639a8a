// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The parts of picture_png(), which are the projection, points, lines and marks.
#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <cstdint>
#include <iterator>
#include <map>
#include <vector>

#include "palette.h"
#include "pcl_bv/report/picture.h"

namespace pcl_bv::detail {

/// A parallel projection. Pixels are counted from the upper left corner. Depth is in pixels, too, and
/// increases away from the viewer.
struct View {
  Eigen::Vector3d right, up, toward;    ///< Orthonormal; `toward` points from the scene to the viewer.
  Eigen::Vector3d world_up;             ///< Picture::up as a unit vector.
  std::array<double, 2> heights{0, 0};  ///< Central range of the points' heights, for colours by height.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;  ///< Pixels per unit; finite.
  int width = 0;
  int height = 0;
  bool empty = true;  ///< Whether there are no points and no volumes to frame.

  /// Returns the pixel coordinates x and y, and the depth. They are not finite if the point is farther away
  /// than the range of doubles.
  Eigen::Vector3d project(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d d = (p - center) * scale;
    return {width / 2.0 + d.dot(right), height / 2.0 - d.dot(up), -d.dot(toward)};
  }
};

/// Returns whether the picture shows this point, which must be finite and not at 0,0,0.
inline bool is_drawn(const Coordinates& p) {
  return is_valid(p) && (p.x != 0 || p.y != 0 || p.z != 0);
}

/// Returns the view of the picture. picture_png() describes its frame.
View fit_view(const Picture& picture);

/// Returns width x height pixels 0xffRRGGBB, row by row. They show the background and the points that are not
/// occluded.
std::vector<std::uint32_t> draw_points(const Picture& picture, const View& view);

/// Styles that distinguish methods. They are colours if each method has its own colour, else dashes.
struct Styles {
  explicit Styles(const Picture& picture);

  std::uint32_t dash(std::uint32_t method) const {
    return by_colour ? method / static_cast<std::uint32_t>(std::size(palette_colours)) : method;
  }

  std::map<std::uint32_t, std::uint32_t> colour_of;  ///< Colour of the first volume of each drawn method.
  bool by_colour;
};

/// Adds a polyline through points of the scene to Cairo's path, or a polygon if `closed`. The line is clipped
/// at 64 pixels outside the picture, because Cairo's coordinates are limited to eight million pixels. A line
/// to a point beyond 1e300 pixels is left out.
void add_path(cairo_t* cairo, const View& view, const std::vector<Eigen::Vector3d>& points, bool closed);

/// Draws and clears Cairo's path. If `front`, the line has a dark outline, so that it stands out from the
/// points.
void stroke(cairo_t* cairo, const Colour& colour, bool front, std::uint32_t dash = 0);

/// Minimum picture size with marks, and the margin that marks need at the lower edge, in pixels.
constexpr int kMinMarkedWidth = 480, kMinMarkedHeight = 320, kMarkMargin = 130;

inline bool has_marks(const View& view) {
  return view.width >= kMinMarkedWidth && view.height >= kMinMarkedHeight;
}

/// Draws the axes (except one along the line of sight), a scale bar, the legend and the volumes' labels.
void draw_marks(cairo_t* cairo, const Picture& picture, const View& view, const Styles& styles);

}  // namespace pcl_bv::detail
