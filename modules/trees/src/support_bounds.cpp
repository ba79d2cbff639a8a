// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Each step of a computation rounds up. The bounds along the axes are those of the volume's aabb().

#include "support_bounds.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"
#include "plane_body.h"

namespace pcl_bv {
namespace {

// Returns the magnitude increased by more than the rounding errors of some tens of sums and products, and
// their underflow.
double inflate_by_rounding(double magnitude) {
  return magnitude * (1 + 0x1p-45) + 0x1p-1000;
}

// Returns the norm. Computes no squares that leave the range of double.
double length(const Eigen::Vector3d& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  return largest > 0 ? norm3(Eigen::Vector3d(v / largest)) * largest : 0;
}

void add_axes(const Aabb& box, CubeSupportBounds& found) {
  for (std::size_t k = 0; k < 3; ++k) {
    found.up[k] = box.max()[static_cast<int>(k)];
    found.down[k] = -box.min()[static_cast<int>(k)];
  }
}

// Each half_width_up() returns an upper bound of n . q and of -n . q for all points q of the volume, relative
// to the volume's centre. `half` is a bound of the absolute coordinates of q.
double half_width_up(const Eigen::Vector3d& n, const Sphere& sphere, const Eigen::Vector3d&) {
  return inflate_by_rounding(length(n) * sphere.radius());
}

// Splits n into the sum of weights[i] axes[i] and a remainder. The split is valid for any weights.
struct AlongAxes {
  Eigen::Vector3d weights;
  double remainder_bound = 0;  // upper bound of |remainder . q|

  AlongAxes(const Eigen::Vector3d& n, const Eigen::Matrix3d& axes, const Eigen::Vector3d& half)
      : weights(dot3(n, axes.col(0)), dot3(n, axes.col(1)), dot3(n, axes.col(2))) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d parts = weights.cwiseProduct(axes.row(k).transpose());
      const double left = n[k] - ((parts[0] + parts[1]) + parts[2]);
      remainder_bound += (std::abs(left) + 0x1p-49 * (std::abs(n[k]) + taxicab3(parts))) * half[k];
    }
  }
};

double half_width_up(const Eigen::Vector3d& n, const Obb& box, const Eigen::Vector3d& half) {
  const AlongAxes along(n, box.axes(), half);
  return inflate_by_rounding(dot3(along.weights.cwiseAbs(), box.half_extents()) + along.remainder_bound);
}

// Cauchy's inequality bounds the projection of the ellipsoid.
double half_width_up(const Eigen::Vector3d& n, const Ellipsoid& ellipsoid, const Eigen::Vector3d& half) {
  const AlongAxes along(n, ellipsoid.axes(), half);
  return inflate_by_rounding(length(along.weights.cwiseProduct(ellipsoid.radii())) + along.remainder_bound);
}

// The part of q along the axis is at most half_height long, and the perpendicular part is at most the radius
// long. For the perpendicular part any multiple of the axis may be subtracted from n.
double half_width_up(const Eigen::Vector3d& n, const Cylinder& cylinder, const Eigen::Vector3d&) {
  const Eigen::Vector3d& a = cylinder.axis();
  const double along = dot3(n, a), error_bound = 0x1p-49 * taxicab3(n);
  const Eigen::Vector3d perpendicular = n - along * a;
  return inflate_by_rounding((std::abs(along) + error_bound) * cylinder.half_height() +
                             (length(perpendicular) + error_bound) * cylinder.radius());
}

struct Measure {
  std::size_t count;

  CubeSupportBounds operator()(const Aabb& box) const {
    CubeSupportBounds found;
    add_axes(box, found);
    for (std::size_t i = 3; i < count; ++i) {
      const Eigen::Vector3d n = cube_vector(i);
      found.up[i] = Expansion().add_dot(n, box.support(n)).up();
      found.down[i] = Expansion().add_dot(-n, box.support(-n)).up();
    }
    return found;
  }

  CubeSupportBounds operator()(const Kdop& kdop) const {
    const PlaneBody body(kdop);
    CubeSupportBounds found = of_planes(body);
    add_axes(kdop.aabb(), found);
    for (std::size_t i = 3; i < count; ++i) {
      for (std::size_t slab = 0; slab < kdop.size(); ++slab) {
        if (kdop.set()->direction(slab) != cube_vector(i)) continue;
        found.up[i] = kdop.max(slab);
        found.down[i] = -kdop.min(slab);
      }
    }
    return found;
  }

  CubeSupportBounds operator()(const Hull& hull) const { return of_planes(PlaneBody(hull)); }

  CubeSupportBounds operator()(const Capsule& capsule) const {
    return centered(capsule.aabb(), [&](const Eigen::Vector3d& n) {
      return std::max(ball_support_up(n, capsule.a(), capsule.radius()),
                      ball_support_up(n, capsule.b(), capsule.radius()));
    });
  }

  // Measures a Sphere, Obb, Cylinder or Ellipsoid.
  template <typename Shape>
  CubeSupportBounds operator()(const Shape& shape) const {
    const Aabb box = shape.aabb();
    const Eigen::Vector3d center = shape.center();
    const Eigen::Vector3d half = 0.5 * (box.max() - box.min());
    return centered(box, [&](const Eigen::Vector3d& n) {
      return Expansion().add_dot(n, center).add(half_width_up(n, shape, half)).up();
    });
  }

  static double ball_support_up(const Eigen::Vector3d& n, const Eigen::Vector3d& center, double radius) {
    return Expansion().add_dot(n, center).add(inflate_by_rounding(length(n) * radius)).up();
  }

  template <typename SupportBound>
  CubeSupportBounds centered(const Aabb& box, const SupportBound& support_bound) const {
    CubeSupportBounds found;
    add_axes(box, found);
    for (std::size_t i = 3; i < count; ++i) {
      found.up[i] = support_bound(cube_vector(i));
      found.down[i] = support_bound(-cube_vector(i));
    }
    return found;
  }

  CubeSupportBounds of_planes(const PlaneBody& body) const {
    CubeSupportBounds found;
    for (std::size_t i = 0; i < count; ++i) {
      found.up[i] = body.support_bound_up(cube_vector(i));
      found.down[i] = body.support_bound_up(-cube_vector(i));
    }
    return found;
  }
};

}  // namespace

CubeSupportBounds cube_support_bounds(const AnyVolume& volume, std::size_t count) {
  return std::visit(Measure{count}, volume);
}

}  // namespace pcl_bv
