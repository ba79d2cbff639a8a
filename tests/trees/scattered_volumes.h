// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes of every kind, some together and some far apart, and those that are none.
#pragma once

#include <vector>

#include "any_volumes.h"

namespace pcl_bv::testing {
using namespace detail;

/// K-DOPs whose slabs have no point in common and hulls whose planes enclose a half space, all or nothing are
/// volumes that are not empty(); then an empty one of each kind.
inline std::vector<AnyVolume> odd_volumes(double size) {
  SlabVector min = SlabVector::Constant(7, -size), max = SlabVector::Constant(7, size);
  min[3] = 5 * size, max[3] = 6 * size;
  const Vector3d zero = Vector3d::Zero();
  return {Kdop(KdopSet::dop14(), min, max),
          Hull({zero}, {}, {{Vector3d(0.1, 0.2, 0.3), 0.5 * size}}, 0),
          Hull({zero}, {}, {{zero, 0}}, 0),
          Hull({zero}, {}, {{zero, -1}}, 0),
          Aabb(),
          Kdop(),
          Sphere(),
          Obb(),
          Cylinder(),
          Capsule(),
          Ellipsoid(),
          Hull(),
          Prism()};
}

/// At least `count`, around the scale's place and up to `spread` extents from it.
inline std::vector<AnyVolume> scattered_volumes(Random& random, const Scale& scale, std::size_t count,
                                                double spread) {
  std::vector<AnyVolume> all;
  while (all.size() < count) {
    Scale here = scale;
    here.offset += random.uniform(-spread, spread) * scale.extent;
    for (const AnyVolume& volume : volumes_of_every_kind(random, here))
      all.push_back(volume);
    if (scale.extent > 1e-150 && scale.extent < 1e90) {
      Eigen::Isometry3d apart = Eigen::Isometry3d::Identity();
      apart.translation() = random.vector(spread * scale.extent);
      for (const AnyVolume& volume :
           {AnyVolume(random_obb(random, scale)), AnyVolume(Sphere(random.point(scale), 0.1 * scale.extent)),
            AnyVolume(around(Kdop(KdopSet::dop18()), random.cloud(scale, Span::solid, 9)))})
        all.push_back(transformed(volume, apart));
    }
  }
  return all;
}

}  // namespace pcl_bv::testing
