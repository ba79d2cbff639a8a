// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Others who fit oriented boxes: PCL, and CGAL where it is installed.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "obb_clouds.h"

namespace pcl_bv::bench {

/// A box as a peer stores it: p is inside if axes * (p - origin) is between low and high.
struct PeerBox {
  Eigen::Vector3d origin;
  Eigen::Matrix3d axes;  ///< Rows, of any length.
  Eigen::Vector3d low, high;

  double volume() const;
  /// By arithmetic in double on these numbers.
  std::size_t points_outside(const ObbCloud& cloud) const;
};

struct ObbPeer {
  std::string name;
  std::string against;  ///< Our method that does the same.
  PeerBox (*run)(const ObbCloud&);
};

/// "CGAL oriented_bounding_box" (with its convex hull, as it comes), "PCL cheapest" (an AABB and a PCA box of
/// getMinMax3D, computeMeanAndCovarianceMatrix, SelfAdjointEigenSolver and a pass), "PCL MomentOfInertia" as
/// it comes, and with one axis only.
const std::vector<ObbPeer>& obb_peers();

}  // namespace pcl_bv::bench
