// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "picture_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "pcl_bv/kernels/point_source.h"

namespace pcl_bv {
namespace {

constexpr double degree = 0.017453292519943295;
// The height of the eye is that of an isometric drawing. Its azimuth is not 45 degrees: streets run along x
// or y in most clouds, and would go straight into a corner of the picture, which is wider than high.
constexpr double elevation = 35 * degree;
constexpr double azimuth = -114 * degree;
constexpr double margin_part = 0.04;  // of each side

/// The interval [low, high] along one axis that something covers.
struct Interval {
  double low = 0, high = 0;
};

/// From the lowest of the lows to the highest of the highs, leaving out the most extreme `cut` of either.
Interval span(std::vector<Interval>& parts, std::size_t cut) {
  Interval result;
  std::nth_element(parts.begin(), parts.begin() + cut, parts.end(),
                   [](const Interval& a, const Interval& b) { return a.low < b.low; });
  result.low = parts[cut].low;
  std::nth_element(parts.begin(), parts.begin() + cut, parts.end(),
                   [](const Interval& a, const Interval& b) { return a.high > b.high; });
  result.high = parts[cut].high;
  return result;
}

using Corners = std::vector<Eigen::Vector3d>;

/// Of each volume that is not empty.
std::vector<Corners> volume_corners(const Picture& picture) {
  std::vector<Corners> corners;
  for (const PictureVolume& entry : picture.volumes) {
    if (!empty(entry.volume)) corners.push_back(mesh(entry.volume).vertices);
  }
  return corners;
}

Interval along(const Corners& corners, const Eigen::Vector3d& axis) {
  Interval interval{INFINITY, -INFINITY};
  for (const Eigen::Vector3d& p : corners) {
    interval.low = std::min(interval.low, p.dot(axis));
    interval.high = std::max(interval.high, p.dot(axis));
  }
  return interval;
}

/// What the frame holds along an axis.
Interval framed(const std::vector<Corners>& volumes, const Corners& points, const Eigen::Vector3d& axis) {
  Interval result{INFINITY, -INFINITY};
  const auto include = [&](std::vector<Interval> parts, std::size_t cut) {
    if (parts.empty()) return;
    const Interval part = span(parts, cut);
    result = {std::min(result.low, part.low), std::max(result.high, part.high)};
  };
  std::vector<Interval> parts;
  parts.reserve(volumes.size());
  for (const Corners& corners : volumes)
    parts.push_back(along(corners, axis));
  // Of a street's hundred objects the few farthest would make all others small.
  include(parts, parts.size() / 16);
  parts.clear();
  for (const Eigen::Vector3d& p : points)
    parts.push_back({p.dot(axis), p.dot(axis)});
  include(parts, parts.size() / 100);
  return result;
}

void look_from_above_a_corner(View& view) {
  const double ce = std::cos(elevation), se = std::sin(elevation);
  const double ca = std::cos(azimuth), sa = std::sin(azimuth);
  view.toward = {ce * ca, ce * sa, se};
  view.right = {-sa, ca, 0};
  view.up = {-se * ca, -se * sa, ce};
}

void look_along_axes(View& view, const Eigen::Vector3d& right, const Eigen::Vector3d& up) {
  view.right = right;
  view.up = up;
  view.toward = right.cross(up);
}

View oriented(const Picture& picture) {
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  View view;
  switch (picture.from) {
    case ViewFrom::iso:
      look_from_above_a_corner(view);
      break;
    case ViewFrom::top:
      look_along_axes(view, x, y);
      break;
    case ViewFrom::front:
      look_along_axes(view, x, z);
      break;
    case ViewFrom::side:
      look_along_axes(view, y, z);
      break;
  }
  view.width = picture.width;
  view.height = picture.height;
  return view;
}

}  // namespace

Corners framed_points(const Picture& picture) {
  constexpr std::size_t enough = 100000;  // stand for any number of points
  Corners points;
  for (std::size_t i = 0; i < picture.points.count; i += picture.points.count / enough + 1) {
    const Coordinates p = load_point(LoadedPoints(picture.points, i, 1).view(), 0);
    const bool counts = !picture.labels || picture.labels[picture.points.index(i)] < label_ground;
    if (counts && is_drawn(p)) points.emplace_back(p.x, p.y, p.z);
  }
  return points;
}

View fit_view(const Picture& picture) {
  View view = oriented(picture);
  const std::vector<Corners> volumes = volume_corners(picture);
  const bool by_points = picture.labels || volumes.empty();
  const Corners points = by_points ? framed_points(picture) : Corners();
  if (volumes.empty() && points.empty()) return view;
  view.empty = false;

  const Eigen::Vector3d axes[3] = {view.right, view.up, view.toward};
  Eigen::Vector3d size;
  for (int k = 0; k < 3; ++k) {
    const Interval covered = framed(volumes, points, axes[k]);
    view.center += (covered.low / 2 + covered.high / 2) * axes[k];
    size[k] = covered.high - covered.low;
  }
  const double fill = std::max(size[0] / picture.width, size[1] / picture.height);
  if (fill > 0) view.scale = (1 - 2 * margin_part) / fill;
  return view;
}

}  // namespace pcl_bv
