// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "picture_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

constexpr double degree = 0.017453292519943295;
// Direction of the viewer in ViewFrom::iso. The elevation is that of an isometric drawing, but the azimuth is
// not half-way between x and y. Most streets run along x or y. In an isometric drawing, a street would run
// diagonally through the picture and would not use the picture's width.
constexpr double elevation = 35 * degree;
constexpr double azimuth = -114 * degree;
constexpr double margin_part = 0.04;  // margin at each side, relative to the picture's size

/// The interval [low, high] along one axis.
struct Interval {
  double low = 0, high = 0;
};

/// Returns the interval from the lowest `low` to the highest `high` of all parts. At each end, the `outliers`
/// most extreme values are ignored. Returns [infinity, -infinity] if there are no parts.
Interval robust_interval(std::vector<Interval>& parts, std::size_t outliers) {
  if (parts.empty()) return {INFINITY, -INFINITY};
  Interval result;
  std::nth_element(parts.begin(), parts.begin() + outliers, parts.end(),
                   [](const Interval& a, const Interval& b) { return a.low < b.low; });
  result.low = parts[outliers].low;
  std::nth_element(parts.begin(), parts.begin() + outliers, parts.end(),
                   [](const Interval& a, const Interval& b) { return a.high > b.high; });
  result.high = parts[outliers].high;
  return result;
}

/// Returns a sample of the points that determine the frame. These are the points in clusters if there are
/// labels, else all points.
std::vector<Eigen::Vector3d> framed_points(const Picture& picture) {
  constexpr std::size_t enough = 100000;  // maximum size of the sample
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < picture.points.count; i += picture.points.count / enough + 1) {
    const Coordinates p = load_point(LoadedPoints(picture.points, i, 1).view(), 0);
    const bool counts = !picture.labels || picture.labels[picture.points.index(i)] < kLabelGround;
    if (counts && is_drawn(p)) points.emplace_back(p.x, p.y, p.z);
  }
  return points;
}

/// Returns the interval of the points along the axis. At each end, one in `extreme` points is ignored.
Interval central_interval(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& axis,
                          std::size_t extreme) {
  std::vector<Interval> parts;
  parts.reserve(points.size());
  for (const Eigen::Vector3d& p : points)
    parts.push_back({p.dot(axis), p.dot(axis)});
  return robust_interval(parts, parts.size() / extreme);
}

/// Returns the interval of the non-empty volumes along the axis, except of those beyond the range of doubles.
/// At each end, one in 16 volumes is ignored. Otherwise a few distant volumes would make all other volumes
/// small in the picture.
Interval central_interval(const std::vector<PictureVolume>& volumes, const Eigen::Vector3d& axis) {
  std::vector<Interval> parts;
  for (const auto& [volume, colour, label, method] : volumes) {
    if (empty(volume)) continue;
    const Interval part{support(volume, -axis).dot(axis), support(volume, axis).dot(axis)};
    if (std::isfinite(part.low) && std::isfinite(part.high)) parts.push_back(part);
  }
  return robust_interval(parts, parts.size() / 16);
}

View oriented(const Picture& picture) {
  View view;
  const Eigen::Vector3d z = view.world_up = (picture.up / picture.up.cwiseAbs().maxCoeff()).normalized();
  const Eigen::Vector3d level = Eigen::Vector3d::Unit(std::abs(z.x()) < 0.9 ? 0 : 1);
  const Eigen::Vector3d x = (level - level.dot(z) * z).normalized(), y = z.cross(x);
  const Eigen::Vector3d level_toward = std::cos(azimuth) * x + std::sin(azimuth) * y;
  const Eigen::Vector3d rights[] = {z.cross(level_toward), x, x, y};  // in the order of ViewFrom
  const Eigen::Vector3d ups[] = {std::cos(elevation) * z - std::sin(elevation) * level_toward, y, z, z};
  view.right = rights[static_cast<int>(picture.from)];
  view.up = ups[static_cast<int>(picture.from)];
  view.toward = view.right.cross(view.up);
  view.width = picture.width;
  view.height = picture.height;
  return view;
}

/// Returns the cropped length of a picture's side, which is `content` pixels and the margins for marks. The
/// length is at least `min_length` and at most `side`.
int cropped(int side, double content, int min_length) {
  const int shown = static_cast<int>(std::max(0.0, std::min<double>(side, content)));
  return std::min(side, std::max(min_length, shown + 2 * kMarkMargin));
}

}  // namespace

View fit_view(const Picture& picture) {
  View view = oriented(picture);
  const bool any_volume = std::any_of(picture.volumes.begin(), picture.volumes.end(),
                                      [](const PictureVolume& entry) { return !empty(entry.volume); });
  std::vector<Eigen::Vector3d> points = framed_points(picture);
  view.empty = !any_volume && points.empty();
  if (view.empty) return view;
  const Interval heights = central_interval(points, view.world_up, 50);
  view.heights = {heights.low, heights.high};
  if (!picture.labels && any_volume) points.clear();

  const Eigen::Vector3d axes[3] = {view.right, view.up, view.toward};
  Eigen::Vector3d size;
  for (int k = 0; k < 3; ++k) {
    const Interval a = central_interval(picture.volumes, axes[k]), b = central_interval(points, axes[k], 100);
    const double low = std::min(a.low, b.low), high = std::max(a.high, b.high);
    view.center += (low / 2 + high / 2) * axes[k];
    size[k] = high - low;
  }
  const double fill = std::max(size[0] / picture.width, size[1] / picture.height);
  // If pixels were smaller, the rounding of the centre would move the scene out of the picture.
  const double least = 0x1p-48 * view.center.cwiseAbs().maxCoeff() / std::min(picture.width, picture.height);
  constexpr double largest_scale = std::numeric_limits<double>::max();
  view.scale = fill > 0 ? std::min((1 - 2 * margin_part) / std::max(fill, least), largest_scale)
                        : std::min(1.0, 1 / least);
  const bool crops = picture.from == ViewFrom::front || picture.from == ViewFrom::side;
  if (crops && has_marks(view)) {
    view.width = cropped(picture.width, size[0] * view.scale, kMinMarkedWidth);
    view.height = cropped(picture.height, size[1] * view.scale, kMinMarkedHeight);
  }
  return view;
}

}  // namespace pcl_bv::detail
