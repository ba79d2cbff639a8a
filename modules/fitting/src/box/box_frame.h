// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A box on its way to a smaller one, turned about one of its axes after the other.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "box/silhouette.h"

namespace pcl_bv {

struct BoxFrame {
  Eigen::Matrix3d axes;
  Eigen::Vector3d size;  ///< Along the axes.
  int axis = 0;          ///< The next turn is about this one.
  int in_vain = 0;       ///< Turns since the last that made the box smaller.

  double volume() const { return size.prod(); }
  bool done() const { return in_vain == 3; }
};

/// The extents of the vertices along the axes.
Eigen::Vector3d extents(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Matrix3d& axes);

/// Turns the frame about its axes, `times` times or until no turn makes the box smaller by more than
/// `smaller` of its area. A turn leads to the smallest box that has the axis.
void turn(BoxFrame& frame, int times, double smaller, const Silhouette& shape, Silhouette::View& view);

}  // namespace pcl_bv
