// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Each step rounds up, so that the result contains the exact inflated volume.

#include "inflated.h"

#include <cmath>

#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/volumes/outline.h"

namespace pcl_bv::detail {
namespace {

// Returns an upper bound of how much n . p grows if p moves by `padding`.
double support_growth(const Eigen::Vector3d& n, double padding) {
  return multiply_up(sqrt_up(Expansion().add_dot(n, n).up()), padding);
}

struct Inflate {
  double padding;

  AnyVolume operator()(const Aabb& box) const {
    const auto add = [this](double x) { return add_up(x, padding); };
    return Aabb(-(-box.min()).unaryExpr(add), box.max().unaryExpr(add));
  }

  AnyVolume operator()(const Kdop& kdop) const {
    SlabVector min = kdop.min(), max = kdop.max();
    for (Eigen::Index i = 0; i < min.size(); ++i) {
      const double by = support_growth(kdop.set()->direction(static_cast<std::size_t>(i)), padding);
      min[i] = -add_up(-min[i], by);
      max[i] = add_up(max[i], by);
    }
    return Kdop(kdop.set(), min, max);
  }

  AnyVolume operator()(const Sphere& sphere) const {
    return Sphere(sphere.center(), add_up(sphere.radius(), padding));
  }

  AnyVolume operator()(const Obb& box) const {
    Eigen::Vector3d half = box.half_extents();
    for (int i = 0; i < 3; ++i)
      half[i] = add_up(half[i], support_growth(box.axis(i), padding));
    return Obb(box.center(), box.axes(), half);
  }

  AnyVolume operator()(const Cylinder& cylinder) const {
    return Cylinder(cylinder.center(), cylinder.axis(), add_up(cylinder.radius(), padding),
                    add_up(cylinder.half_height(), padding));
  }

  AnyVolume operator()(const Capsule& capsule) const {
    return Capsule(capsule.a(), capsule.b(), add_up(capsule.radius(), padding));
  }

  // Proof that the result holds all sums of a point of the ellipsoid and a point of the padding ball. Let x
  // and y be the coordinates of the two points along an axis, m > 0, and R the new radius as in Region.
  // Cauchy's inequality gives
  //   (x + y)^2 / R^2 <= (x^2 / r^2) m / (m + padding) + (y^2 / padding^2) padding / (m + padding).
  // Over the three axes the right sides sum up to at most 1. The axes are orthonormal to 1e-12, so the sum of
  // y^2 is at most (1 + 2^-38) padding^2.
  AnyVolume operator()(const Ellipsoid& ellipsoid) const {
    const double ball = multiply_up(padding, 1 + 0x1p-38);
    const double m = nearly_minimal_m(ellipsoid.radii());
    const auto inflate = [&](double r) {
      const double quotient = m > 0 ? next_up(multiply_up(r, r) / m) : 0;
      const double sum = add_up(multiply_up(r, r), multiply_up(ball, add_up(add_up(ball, m), quotient)));
      return sqrt_up(sum);
    };
    return Ellipsoid(ellipsoid.center(), ellipsoid.axes(), ellipsoid.radii().unaryExpr(inflate));
  }

  AnyVolume operator()(const Hull& hull) const {
    std::vector<HullPlane> planes = hull.planes();
    for (HullPlane& plane : planes)
      plane.offset = add_up(plane.offset, support_growth(plane.normal, padding));
    return Hull(hull.vertices(), hull.triangles(), planes, hull.rank());
  }

  AnyVolume operator()(const Prism& prism) const { return inflated_prism(prism, padding); }

  // Returns an m with which the volume is nearly minimal. At the minimum, m^2 is the mean of the r^2 with the
  // weights 1/R^2. With any m > 0 the volume contains all points within `padding` of the ellipsoid.
  double nearly_minimal_m(const Eigen::Vector3d& radii) const {
    const double largest = radii.maxCoeff();
    if (largest == 0) return 0;
    double m = 1;  // in units of the largest radius, in which nothing overflows
    for (int round = 0; round < 32; ++round) {
      double squares = 0, weights = 0;
      for (int i = 0; i < 3; ++i) {
        const double r = radii[i] / largest, by = padding / largest;
        const double weight = 1 / (r * r + by * (by + m + r * r / m));
        squares += weight * r * r;
        weights += weight;
      }
      m = std::sqrt(squares / weights);
    }
    return std::isnan(m) ? largest : m * largest;  // NaN if squares left the range of double
  }
};

}  // namespace

AnyVolume inflated(const AnyVolume& volume, double padding) {
  if (padding == 0 || empty(volume)) return volume;
  return std::visit(Inflate{padding}, volume);
}

}  // namespace pcl_bv::detail
