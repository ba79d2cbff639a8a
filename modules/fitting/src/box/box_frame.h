// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A box around a hull, and rotations of the box about its axes that make the box smaller.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "box/silhouette.h"

namespace pcl_bv::detail {

struct BoxFrame {
  Eigen::Matrix3d axes;
  Eigen::Vector3d size;  ///< Extents along the axes.
  int axis = 0;          ///< The next rotation is about this axis.
  int stuck_axes = 0;    ///< Number of successive axes about which no rotation shrinks the box.

  double volume() const { return size.prod(); }
  bool done() const { return stuck_axes == 3; }
};

/// Returns the extents of the vertices along the axes.
Eigen::Vector3d extents(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Matrix3d& axes);

/// Rotates the frame about one axis after another, each time to the smallest box with this axis. Ends after
/// `times` rotations, or when no rotation about any of the three axes reduces the area perpendicular to that
/// axis by more than the fraction `smaller`.
void shrink_frame(BoxFrame& frame, int times, double smaller, const Silhouette& shape,
                  Silhouette::Projection& projection);

}  // namespace pcl_bv::detail
