// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Each step rounds up. Along an axis a volume's box says how far it reaches.

#include "reaches.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"
#include "plane_body.h"

namespace pcl_bv {
namespace {

Eigen::Vector3d cube_vector(std::size_t i) {
  const CubeDirection& d = kCubeDirections[i];
  return {static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
}

double dot_up(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Expansion().add_dot(a, b).up();
}

double length_up(const Eigen::Vector3d& v) {
  return sqrt_up(dot_up(v, v));
}

void add_axes(const Aabb& box, Reaches& found) {
  for (std::size_t k = 0; k < 3; ++k) {
    found.up[k] = box.max()[static_cast<int>(k)];
    found.down[k] = -box.min()[static_cast<int>(k)];
  }
}

// How far n . q reaches, for q from the centre of the volume on; the same for -n.
double half_width_up(const Eigen::Vector3d& n, const Sphere& sphere) {
  return multiply_up(length_up(n), sphere.radius());
}

// n = sum of w[i] a[i] + rest, and |a[i] . q| is known; |q[k]| is at most half[k].
template <typename Along>
double half_width_up(const Eigen::Vector3d& n, const Eigen::Matrix3d& axes, const Eigen::Vector3d& half,
                     const Along& along) {
  const Eigen::Vector3d weights(dot3(n, axes.col(0)), dot3(n, axes.col(1)), dot3(n, axes.col(2)));
  double sum = along(weights);
  for (int k = 0; k < 3; ++k) {
    Expansion rest;
    rest.add(n[k]);
    for (int i = 0; i < 3; ++i)
      rest.add_product(-weights[i], axes(k, i));
    sum = add_up(sum, multiply_up(rest.magnitude_up(), half[k]));
  }
  return sum;
}

// The half sizes of a box about the centre.
Eigen::Vector3d half_box(const Eigen::Vector3d& center, const Aabb& box) {
  Eigen::Vector3d half;
  for (int k = 0; k < 3; ++k)
    half[k] = std::max(add_up(box.max()[k], -center[k]), add_up(center[k], -box.min()[k]));
  return half;
}

double half_width_up(const Eigen::Vector3d& n, const Obb& box) {
  return half_width_up(
      n, box.axes(), half_box(box.center(), box.aabb()),
      [&](const Eigen::Vector3d& weights) { return dot_up(weights.cwiseAbs(), box.half_extents()); });
}

// By Cauchy's inequality.
double half_width_up(const Eigen::Vector3d& n, const Ellipsoid& ellipsoid) {
  const Eigen::Vector3d half = half_box(ellipsoid.center(), ellipsoid.aabb());
  return half_width_up(n, ellipsoid.axes(), half, [&](const Eigen::Vector3d& weights) {
    Eigen::Vector3d parts;
    for (int i = 0; i < 3; ++i)
      parts[i] = multiply_up(std::abs(weights[i]), ellipsoid.radii()[i]);
    return length_up(parts);
  });
}

// q is a part along the axis, of at most half_height, and one across, of at most the radius: there n may be
// taken without any multiple of the axis.
double half_width_up(const Eigen::Vector3d& n, const Cylinder& cylinder) {
  const Eigen::Vector3d& a = cylinder.axis();
  const double along = Expansion().add_dot(n, a).magnitude_up() * (1 + 0x1p-48),
               weight = dot3(n, a) / dot3(a, a);
  Eigen::Vector3d across;
  for (int k = 0; k < 3; ++k)
    across[k] = Expansion().add(n[k]).add_product(-weight, a[k]).magnitude_up();
  return add_up(multiply_up(along, cylinder.half_height()),
                multiply_up(length_up(across), cylinder.radius()));
}

struct Measure {
  std::size_t count;

  Reaches operator()(const Aabb& box) const {
    Reaches found;
    add_axes(box, found);
    for (std::size_t i = 3; i < count; ++i) {
      const Eigen::Vector3d n = cube_vector(i);
      found.up[i] = Expansion().add_dot(n, box.support(n)).up();
      found.down[i] = Expansion().add_dot(-n, box.support(-n)).up();
    }
    return found;
  }

  Reaches operator()(const Kdop& kdop) const {
    const PlaneBody body(kdop);
    Reaches found = of_planes(body);
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

  Reaches operator()(const Hull& hull) const { return of_planes(PlaneBody(hull)); }

  Reaches operator()(const Capsule& capsule) const {
    return centered(capsule.aabb(), [&](const Eigen::Vector3d& n) {
      return std::max(reach_up(n, capsule.a(), capsule.radius()), reach_up(n, capsule.b(), capsule.radius()));
    });
  }

  // Sphere, Obb, Cylinder, Ellipsoid.
  template <typename Shape>
  Reaches operator()(const Shape& shape) const {
    return centered(shape.aabb(), [&](const Eigen::Vector3d& n) {
      return Expansion().add_dot(n, shape.center()).add(half_width_up(n, shape)).up();
    });
  }

  static double reach_up(const Eigen::Vector3d& n, const Eigen::Vector3d& center, double radius) {
    return Expansion().add_dot(n, center).add(multiply_up(length_up(n), radius)).up();
  }

  template <typename Reach>
  Reaches centered(const Aabb& box, const Reach& reach) const {
    Reaches found;
    add_axes(box, found);
    for (std::size_t i = 3; i < count; ++i) {
      found.up[i] = reach(cube_vector(i));
      found.down[i] = reach(-cube_vector(i));
    }
    return found;
  }

  Reaches of_planes(const PlaneBody& body) const {
    Reaches found;
    for (std::size_t i = 0; i < count; ++i) {
      found.up[i] = body.reach_up(cube_vector(i));
      found.down[i] = body.reach_up(-cube_vector(i));
    }
    return found;
  }
};

}  // namespace

Reaches reaches(const AnyVolume& volume, std::size_t count) {
  return std::visit(Measure{count}, volume);
}

}  // namespace pcl_bv
