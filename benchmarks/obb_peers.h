// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Others who fit oriented boxes: PCL, and CGAL where it is installed.
#pragma once

#include <string>
#include <vector>

#include "obb_clouds.h"

namespace pcl_bv::bench {

struct ObbPeer {
  std::string name;
  std::string against;             ///< Our method that does the same.
  double (*run)(const ObbCloud&);  ///< Gives the volume of its box.
};

/// "CGAL oriented_bounding_box" (with its convex hull, as it comes), "PCL cheapest" (an AABB and a PCA box of
/// getMinMax3D, computeMeanAndCovarianceMatrix, SelfAdjointEigenSolver and a pass), "PCL MomentOfInertia" as
/// it comes, and with one axis only.
const std::vector<ObbPeer>& obb_peers();

}  // namespace pcl_bv::bench
