// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a picture is put together from.
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

/// A parallel projection. Pixels count from the upper left corner; depth grows away from the viewer and is in
/// pixels too, so that a cube looks like one.
struct View {
  Eigen::Vector3d right, up, toward;    ///< Orthonormal; `toward` points from the scene to the viewer.
  Eigen::Vector3d sky;                  ///< Picture::up, a unit vector.
  std::array<double, 2> heights{0, 1};  ///< Central ones of the points, for the colours by height.
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

/// Rows of width x height pixels 0xffRRGGBB: the background and, nearest first, the points.
std::vector<std::uint32_t> draw_points(const Picture& picture, const View& view);

/// How the methods drawn are told apart: by colour if each has one of its own, else by dashes.
struct Styles {
  explicit Styles(const Picture& picture);

  std::uint32_t dash(std::uint32_t method) const {
    return by_colour ? method / static_cast<std::uint32_t>(std::size(palette_colours)) : method;
  }

  std::map<std::uint32_t, std::uint32_t> colour_of;  ///< Of each method drawn, that of its first volume.
  bool by_colour;
};

/// Adds lines through points of the scene to Cairo's path, or (`closed`) around an area, cut off somewhat
/// outside the picture: Cairo's numbers end at eight million pixels.
void add_path(cairo_t* cairo, const View& view, const std::vector<Eigen::Vector3d>& points, bool closed);

/// Draws the path, and forgets it. One dark stroke below the coloured one keeps lines in front crisp on a
/// crowd of points.
void stroke(cairo_t* cairo, const Colour& colour, bool front, std::uint32_t dash = 0);

/// Below this size there is no room for marks; `mark_room` is what they take of the lower edge.
constexpr int marked_width = 480, marked_height = 320, mark_room = 130;

inline bool has_marks(const View& view) {
  return view.width >= marked_width && view.height >= marked_height;
}

/// Draws the axes that are not seen end-on and a scale bar, the legend and the volumes' labels.
void draw_marks(cairo_t* cairo, const Picture& picture, const View& view, const Styles& styles);

}  // namespace pcl_bv
