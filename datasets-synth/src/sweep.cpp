// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace pcl_bv::detail {
namespace {

/// Adds the object to the columns whose rays may hit the object. These columns lie between the smallest and
/// the largest azimuth of the corners of the object's box. The azimuths are measured from the azimuth of the
/// box's middle, from -pi to pi. If the sensor is inside the object's footprint, such as below a bridge, all
/// columns are added.
void add_candidate(std::vector<std::vector<ColumnCandidate>>& columns, const PlacedObject& object) {
  const double nearest = min_range(object);
  if (nearest == 0) {
    for (auto& column : columns)
      column.push_back({0, &object});
    return;
  }
  const Box3& box = object.model.bounds;
  const Vec3 middle = object.to_sensor(0.5 * (box.lo + box.hi));
  const double azimuth = std::atan2(middle.y, middle.x);
  double low = 0;
  double high = 0;
  for (const double x : {box.lo.x, box.hi.x}) {
    for (const double y : {box.lo.y, box.hi.y}) {
      for (const double z : {box.lo.z, box.hi.z}) {  // top and bottom of a tilted box differ in azimuth
        const Vec3 corner = object.to_sensor({x, y, z});
        const double turn = std::remainder(std::atan2(corner.y, corner.x) - azimuth, 2 * std::numbers::pi);
        low = std::min(low, turn);
        high = std::max(high, turn);
      }
    }
  }
  const auto count = static_cast<std::int64_t>(columns.size());
  const double per_radian = static_cast<double>(count) / (2 * std::numbers::pi);
  const auto column_at = [&](double angle) { return (std::numbers::pi - angle) * per_radian - 0.5; };
  const auto first = static_cast<std::int64_t>(std::floor(column_at(azimuth + high)));
  const auto last = static_cast<std::int64_t>(std::ceil(column_at(azimuth + low)));
  for (std::int64_t column = first; column <= std::min(last, first + count - 1); ++column) {
    columns[static_cast<std::size_t>((column % count + count) % count)].push_back({nearest, &object});
  }
}

}  // namespace

double azimuth_of(double column, std::size_t columns) {
  return std::numbers::pi * (1 - 2 * (column + 0.5) / static_cast<double>(columns));
}

std::vector<std::vector<ColumnCandidate>> candidates_by_column(const std::vector<PlacedObject>& objects,
                                                               std::size_t columns) {
  std::vector<std::vector<ColumnCandidate>> candidates(columns);
  for (const PlacedObject& object : objects)
    add_candidate(candidates, object);
  for (auto& column : candidates) {
    std::sort(column.begin(), column.end(),
              [](const ColumnCandidate& a, const ColumnCandidate& b) { return a.min_range < b.min_range; });
  }
  return candidates;
}

}  // namespace pcl_bv::detail
