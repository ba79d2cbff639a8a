// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/box_frame.h"

#include <algorithm>

#include "box/rectangle.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {

Eigen::Vector3d extents(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Matrix3d& axes) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(kInfinity), high = -low;
  for (const Eigen::Vector3d& p : vertices) {
    for (int i = 0; i < 3; ++i) {
      const double along = dot3(axes.col(i), p);
      low[i] = std::min(low[i], along);
      high[i] = std::max(high[i], along);
    }
  }
  return high - low;
}

void shrink_frame(BoxFrame& frame, int times, double smaller, const Silhouette& shape,
                  Silhouette::Projection& projection) {
  for (; times > 0 && !frame.done(); --times) {
    const int b = (frame.axis + 1) % 3, c = (frame.axis + 2) % 3;
    frame.axis = b;
    const Eigen::Vector3d u = frame.axes.col(b), v = frame.axes.col(c);
    const std::vector<Eigen::Vector2d>& corners = shape.project(u, v, projection);
    const Rectangle box = smallest_rectangle(corners.data(), corners.size());
    if (!(box.area() < frame.size[b] * frame.size[c] * (1 - smaller))) {
      ++frame.stuck_axes;
      continue;
    }
    frame.axes.col(b) = box.side.x() * u + box.side.y() * v;
    frame.axes.col(c) = box.side.x() * v - box.side.y() * u;
    frame.size[b] = box.width;
    frame.size[c] = box.height;
    frame.stuck_axes = 1;  // Another rotation about this axis cannot shrink the box.
  }
}

}  // namespace pcl_bv::detail
