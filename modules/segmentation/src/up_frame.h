// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>

namespace pcl_bv {

/// Up and two level directions, of unit length and at right angles: for an axis of the cloud the axes after
/// it, so x and y for z and -z; else those of the nearest axis, turned with it the shortest way to up. Throws
/// as up_direction().
struct UpFrame {
  explicit UpFrame(const Eigen::Vector3d& any_length);

  Eigen::Vector3d u, v, up;
  Eigen::Index nearest = 0;  ///< The axis nearest to up.
  bool along_axis;           ///< Whether up is that axis, or its opposite.
};

}  // namespace pcl_bv
