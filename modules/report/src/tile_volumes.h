// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The values of "boundingVolume" of 3D Tiles.
#pragma once

#include "json_text.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {

inline void add_tile_volume(const Obb& box, JsonText& json) {
  const Eigen::Matrix3d half = box.axes() * box.half_extents().asDiagonal();
  Eigen::Matrix<double, 12, 1> twelve;
  twelve << box.center(), half.col(0), half.col(1), half.col(2);
  json.begin('{').add("box", twelve).end('}');
}

inline void add_tile_volume(const Sphere& sphere, JsonText& json) {
  const Eigen::Vector3d& c = sphere.center();
  json.begin('{').add("sphere", std::array{c.x(), c.y(), c.z(), sphere.radius()}).end('}');
}

}  // namespace pcl_bv::detail
