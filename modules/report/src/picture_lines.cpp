// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <set>
#include <utility>

#include "picture_parts.h"

namespace pcl_bv::detail {
namespace {

using Path = std::vector<Eigen::Vector3d>;

/// Returns the part of a path in the half-plane sign * p[axis] <= limit. Where an open path leaves the
/// half-plane and returns, the result connects the two points at which the path crosses the boundary.
Path clip_path(const Path& path, bool closed, int axis, double sign, double limit) {
  Path clipped;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Vector3d &a = path[i > 0 ? i - 1 : path.size() - 1], &b = path[i];
    const bool inside = sign * b[axis] <= limit;
    if ((i > 0 || closed) && (sign * a[axis] <= limit) != inside) {
      clipped.push_back(a + (sign * limit - a[axis]) / (b[axis] - a[axis]) * (b - a));
      clipped.back()[axis] = sign * limit;
    }
    if (inside) clipped.push_back(b);
  }
  return clipped;
}

}  // namespace

Styles::Styles(const Picture& picture) {
  std::set<std::uint32_t> colours;
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const PictureVolume& entry : picture.volumes) {
    if (empty(entry.volume)) continue;
    colour_of.emplace(entry.method, entry.colour);
    colours.insert(entry.colour);
    pairs.emplace(entry.method, entry.colour);
  }
  by_colour = pairs.size() == colour_of.size() && pairs.size() == colours.size();
}

void add_path(cairo_t* cairo, const View& view, const std::vector<Eigen::Vector3d>& points, bool closed) {
  constexpr double beyond = 64;  // pixels outside the picture, wider than any line
  Path path;
  for (const Eigen::Vector3d& point : points) {
    path.push_back(view.project(point));
    if (!(path.back().array().abs() < 1e300).all()) return;  // also for NaN
  }
  for (const int axis : {0, 1}) {
    path = clip_path(path, closed, axis, 1, beyond + (axis == 0 ? view.width : view.height));
    path = clip_path(path, closed, axis, -1, beyond);
  }
  for (const Eigen::Vector3d& at : path)
    cairo_line_to(cairo, at.x(), at.y());
  if (closed && !path.empty()) cairo_close_path(cairo);
  cairo_new_sub_path(cairo);
}

void stroke(cairo_t* cairo, const Colour& colour, bool front, std::uint32_t dash) {
  static const std::vector<double> dashes[] = {
      {}, {9, 7}, {2, 4}, {14, 6, 0, 6}, {24, 8}, {14, 5, 0, 5, 0, 5}};
  const std::vector<double>& pattern = dashes[dash % std::size(dashes)];
  cairo_set_dash(cairo, pattern.data(), static_cast<int>(pattern.size()), 0);
  if (front) {
    cairo_set_line_width(cairo, 3.6);
    cairo_set_source_rgba(cairo, 0.03, 0.04, 0.07, 0.55);
    cairo_stroke_preserve(cairo);
  }
  cairo_set_line_width(cairo, front ? 1.6 : 1.0);
  cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2], front ? 0.95 : 0.32);
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0);
}

}  // namespace pcl_bv::detail
