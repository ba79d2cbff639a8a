// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "rotatable.h"

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

// Returns the polytope of a k-DOP as a hull. Each plane moves outward by `error_bound`, which covers the
// rounding of its normal.
Hull hull_of(const Kdop& kdop) {
  const Mesh mesh = kdop.mesh();
  if (mesh.vertices.empty()) return {};
  const Aabb box = kdop.aabb();
  const double error_bound = 0x1p-48 * (taxicab3(box.min()) + taxicab3(box.max())) + kSmallestNormal;
  std::vector<HullPlane> planes;
  for (std::size_t i = 0; i < kdop.size(); ++i) {
    const Eigen::Vector3d& n = kdop.set()->direction(i);
    const double length = n.stableNorm();
    planes.push_back({n / length, kdop.max(i) / length + error_bound});
    planes.push_back({-n / length, -kdop.min(i) / length + error_bound});
  }
  return {mesh.vertices, {}, planes, 3};
}

struct ToRotatable {
  AnyVolume operator()(const Aabb& box) const { return Obb(box); }
  AnyVolume operator()(const Kdop& kdop) const { return kdop.empty() ? Hull() : hull_of(kdop); }
  template <typename Volume>
  AnyVolume operator()(const Volume& volume) const {
    return volume;
  }
};

}  // namespace

AnyVolume rotatable(const AnyVolume& volume) {
  return std::visit(ToRotatable{}, volume);
}

}  // namespace pcl_bv::detail
