// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// An orthonormal frame with a given up direction.
#pragma once

#include <Eigen/Core>

namespace pcl_bv::detail {

/// Three orthogonal unit vectors, namely `up` and two horizontal directions u and v. If `up` is along an axis
/// of the cloud or opposite to it, u and v are the next two axes, e.g. x and y for z and -z. Otherwise the
/// axis nearest to `up` is rotated to `up` by the smallest rotation, and u and v are the next two axes,
/// rotated in the same way. Throws as normalized_up().
struct UpFrame {
  explicit UpFrame(const Eigen::Vector3d& any_length);

  Eigen::Vector3d u, v, up;
  Eigen::Index nearest = 0;  ///< Index of the axis nearest to up.
  bool along_axis;           ///< Whether `up` is along the nearest axis or opposite to it.
};

}  // namespace pcl_bv::detail
