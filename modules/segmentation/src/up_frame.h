// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// An orthonormal frame with a given up direction.
#pragma once

#include <Eigen/Core>

namespace pcl_bv {

/// Three orthogonal unit vectors: `up` and two horizontal directions u and v. If up is an axis of the cloud
/// or its opposite, u and v are the two next axes: x and y for z and -z. Otherwise they are the axes after
/// the nearest axis, rotated by the smallest rotation of that axis to up. Throws as normalized_up().
struct UpFrame {
  explicit UpFrame(const Eigen::Vector3d& any_length);

  Eigen::Vector3d u, v, up;
  Eigen::Index nearest = 0;  ///< Index of the axis nearest to up.
  bool along_axis;           ///< Whether up is this axis or its opposite.
};

}  // namespace pcl_bv
