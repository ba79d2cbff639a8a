// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The parts of picture_png(): projection, points, lines and marks.
#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <cstdint>
#include <iterator>
#include <map>
#include <vector>

#include "palette.h"
#include "pcl_bv/report/picture.h"

namespace pcl_bv {

/// A parallel projection. Pixels are counted from the upper left corner. Depth increases away from the viewer
/// and is in pixels, too.
struct View {
  Eigen::Vector3d right, up, toward;    ///< Orthonormal; `toward` points from the scene to the viewer.
  Eigen::Vector3d world_up;             ///< Picture::up as a unit vector.
  std::array<double, 2> heights{0, 1};  ///< Central range of the points' heights, for colours by height.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;  ///< Pixels per unit.
  int width = 0;
  int height = 0;
  bool empty = true;  ///< There are no points and no volumes to frame.

  /// Returns pixel x, pixel y and depth.
  Eigen::Vector3d project(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d d = (p - center) * scale;
    return {width / 2.0 + d.dot(right), height / 2.0 - d.dot(up), -d.dot(toward)};
  }
};

/// Whether the picture shows this point: it is finite and not at 0,0,0.
inline bool is_drawn(const Coordinates& p) {
  return is_valid(p) && (p.x != 0 || p.y != 0 || p.z != 0);
}

/// Returns the view with the frame that picture_png() documents.
View fit_view(const Picture& picture);

/// Returns rows of width x height pixels 0xffRRGGBB: the background and the points, without occluded ones.
std::vector<std::uint32_t> draw_points(const Picture& picture, const View& view);

/// How methods are distinguished: by colour if each method has its own colour, else by dashes.
struct Styles {
  explicit Styles(const Picture& picture);

  std::uint32_t dash(std::uint32_t method) const {
    return by_colour ? method / static_cast<std::uint32_t>(std::size(palette_colours)) : method;
  }

  std::map<std::uint32_t, std::uint32_t> colour_of;  ///< Colour of each drawn method's first volume.
  bool by_colour;
};

/// Adds a polyline through points of the scene to Cairo's path, or a polygon if `closed`. It is clipped
/// somewhat outside the picture, since Cairo's coordinates are limited to eight million pixels.
void add_path(cairo_t* cairo, const View& view, const std::vector<Eigen::Vector3d>& points, bool closed);

/// Draws and clears Cairo's path. Lines in front have a dark outline, so that they stand out from the points.
void stroke(cairo_t* cairo, const Colour& colour, bool front, std::uint32_t dash = 0);

/// Minimum picture size with marks, and the margin at the lower edge that marks need, in pixels.
constexpr int kMinMarkedWidth = 480, kMinMarkedHeight = 320, kMarkMargin = 130;

inline bool has_marks(const View& view) {
  return view.width >= kMinMarkedWidth && view.height >= kMinMarkedHeight;
}

/// Draws the axes (except one along the line of sight), a scale bar, the legend and the volumes' labels.
void draw_marks(cairo_t* cairo, const Picture& picture, const View& view, const Styles& styles);

}  // namespace pcl_bv
