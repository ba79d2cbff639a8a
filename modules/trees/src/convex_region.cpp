// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "convex_region.h"

#include <algorithm>
#include <cmath>

#include "inflated.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/outline.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

Direction direction(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

// Returns a margin along an axis. The margin is larger than that of contains() of any volume type.
double margin(double coordinate) {
  return 0x1p-40 * std::abs(coordinate) + 0x1p-480;
}

ConvexRegion around(const AnyVolume& volume, RegionShape shape, const Eigen::Vector3d& center,
                    const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity()) {
  const Aabb tight = aabb(volume);
  const double size = std::max(tight.min().cwiseAbs().maxCoeff(), tight.max().cwiseAbs().maxCoeff());
  const Aabb box = aabb(inflated(volume, margin(size)));
  ConvexRegion region;
  region.shape = shape;
  region.low = coordinates(box.min());
  region.high = coordinates(box.max());
  region.center = coordinates(center);
  for (int i = 0; i < 3; ++i)
    region.axes[static_cast<std::size_t>(i)] = direction(axes.col(i));
  return region;
}

Eigen::Matrix3d axes_about(const Eigen::Vector3d& unit) {
  Eigen::Matrix3d axes;
  axes.col(0) = unit;
  axes.col(1) = unit.unitOrthogonal();
  axes.col(2) = cross3(axes.col(0), axes.col(1));
  return axes;
}

// Collects half-spaces relative to a centre. A plane perpendicular to an axis also gives a side of the
// region's box. The side is margin() beyond the plane, because contains() accepts points that are less than
// this distance beyond the plane.
class Planes {
 public:
  explicit Planes(const Aabb& box) : center_(box.empty() ? Eigen::Vector3d::Zero().eval() : box.center()) {
    region_.shape = RegionShape::planes;
    region_.low = {-kInfinity, -kInfinity, -kInfinity};
    region_.high = {kInfinity, kInfinity, kInfinity};
    region_.center = coordinates(center_);
  }

  void add(const Eigen::Vector3d& normal, double offset) {
    const double length = normal.stableNorm();
    const Eigen::Vector3d n = normal / length;
    region_.planes.push_back({n.x(), n.y(), n.z(), offset / length - dot3(n, center_)});
    region_.surface_error =
        std::max(region_.surface_error, 0x1p-45 * (std::abs(offset / length) + taxicab3(center_)));
    bound(n, offset / length, region_.low.x, region_.high.x, 0);
    bound(n, offset / length, region_.low.y, region_.high.y, 1);
    bound(n, offset / length, region_.low.z, region_.high.z, 2);
  }

  // Sets a minimum for the error of the surface, for planes computed from coordinates of this magnitude.
  void allow_rounding_of(double magnitude) {
    region_.surface_error = std::max(region_.surface_error, 0x1p-45 * magnitude);
  }

  // Adds a plane that leaves every point unclear, so that contains() decides about all points which the other
  // planes do not exclude.
  void leave_inside_unclear() { region_.planes.push_back({0, 0, 0, 0}); }

  // Limits the region to a box, which must contain every point for which contains() is true.
  void limit(const Aabb& box) {
    region_.low = coordinates(vector(region_.low).cwiseMax(box.min()));
    region_.high = coordinates(vector(region_.high).cwiseMin(box.max()));
  }

  // Returns the region. A side of its box is infinite if no plane is perpendicular to the axis there. Fitted
  // volumes have planes for all six sides.
  const ConvexRegion& region() const { return region_; }

 private:
  // Uses only normals exactly along the axis. A nearly aligned normal has a small component along another
  // axis. This component matters in n . p if the coordinate of p along that axis is 10^16 times the other
  // coordinates.
  static void bound(const Eigen::Vector3d& n, double offset, double& low, double& high, int axis) {
    if (n[(axis + 1) % 3] != 0 || n[(axis + 2) % 3] != 0) return;
    if (n[axis] == 1) high = std::min(high, offset + margin(offset));
    if (n[axis] == -1) low = std::max(low, -offset - margin(offset));
  }

  Eigen::Vector3d center_;
  ConvexRegion region_;
};

ConvexRegion region_of(const Aabb& box) {
  ConvexRegion region;
  region.low = coordinates(box.min());
  region.high = coordinates(box.max());
  return region;
}

ConvexRegion region_of(const Kdop& kdop) {
  Planes planes(kdop.aabb());
  for (std::size_t i = 0; i < kdop.size(); ++i) {
    planes.add(kdop.set()->direction(i), kdop.max(i));
    planes.add(-kdop.set()->direction(i), -kdop.min(i));
  }
  return planes.region();
}

ConvexRegion region_of(const Hull& hull) {
  Planes planes(hull.aabb());
  for (const HullPlane& plane : hull.planes())
    planes.add(plane.normal, plane.offset);
  return planes.region();
}

Eigen::Vector2d outward(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()).stableNormalized();
}

// Returns sin(a / 2) for the smallest interior angle a of the outline.
double sine_of_sharpest(const std::vector<Eigen::Vector2d>& outline) {
  double least = 1;
  const std::size_t count = outline.size();
  for (std::size_t i = 0; i < count && count > 2; ++i) {
    const Eigen::Vector2d &at = outline[i], &next = outline[(i + 1) % count];
    least = std::min(least, 0.5 * (outward(outline[(i + count - 1) % count], at) + outward(at, next)).norm());
  }
  return least;
}

// Returns a box that contains every point for which contains() is true, and every ray's interval. The error
// bounds of a side are below 2^-46 of the largest coordinate. Beyond a corner they are divided by the sine,
// but the box of the outline is also tested.
Aabb box_of_contained(const Prism& prism) {
  const Aabb box = prism.aabb();
  Eigen::Vector2d low = prism.outline()[0], high = low;
  for (const Eigen::Vector2d& corner : prism.outline()) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const double rounding = margin(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()));
  const double beyond_corner =
      std::min(0x1p-5 * rounding / sine_of_sharpest(prism.outline()), 1.001 * (high - low).stableNorm());
  const Eigen::Vector3d by = Eigen::Vector3d::Constant(rounding + beyond_corner);
  return {box.min() - by, box.max() + by};
}

// The normals are rotated and rounded, so each has a relative error below 2^-50. The error of the edge's
// direction is within the same bound, because the difference of two doubles is rounded once.
ConvexRegion region_of(const Prism& original) {
  const Prism prism = convex_prism(original);
  const std::vector<Eigen::Vector2d>& outline = prism.outline();
  const Aabb box = prism.aabb();
  Planes planes(box);
  planes.add(prism.up(), prism.high());
  planes.add(-prism.up(), -prism.low());
  const Eigen::Vector3d east = prism.axes().col(0), north = prism.axes().col(1);
  Eigen::Vector2d low = outline[0], high = outline[0];
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[i + 1 < outline.size() ? i + 1 : 0];
    low = low.cwiseMin(a);
    high = high.cwiseMax(a);
    if (a == b) continue;
    const Eigen::Vector2d n = outward(a, b);
    planes.add(n.x() * east + n.y() * north, n.x() * a.x() + n.y() * a.y());
  }
  planes.add(east, high.x());
  planes.add(-east, -low.x());
  planes.add(north, high.y());
  planes.add(-north, -low.y());
  planes.allow_rounding_of(box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).sum());
  planes.limit(box_of_contained(prism));
  if (!original.is_convex()) planes.leave_inside_unclear();
  return planes.region();
}

ConvexRegion region_of(const Sphere& sphere) {
  ConvexRegion region = around(sphere, RegionShape::ball, sphere.center());
  region.radius = sphere.radius();
  return region;
}

ConvexRegion region_of(const Obb& box) {
  ConvexRegion region = around(box, RegionShape::slabs, box.center(), box.axes());
  region.slab = direction(box.half_extents());
  return region;
}

ConvexRegion region_of(const Cylinder& cylinder) {
  ConvexRegion region =
      around(cylinder, RegionShape::rounded, cylinder.center(), axes_about(cylinder.axis()));
  region.slab[0] = cylinder.half_height();
  region.weight = {0, 1, 1};
  region.radius = cylinder.radius();
  return region;
}

ConvexRegion region_of(const Capsule& capsule) {
  const Eigen::Vector3d edge = capsule.b() - capsule.a();
  const double length = edge.stableNorm();
  const Eigen::Vector3d unit = length > 0 ? Eigen::Vector3d(edge / length) : Eigen::Vector3d::UnitX();
  ConvexRegion region = around(capsule, RegionShape::rounded, capsule.a() + 0.5 * edge, axes_about(unit));
  region.surface_error = 0x1p-50 * (taxicab3(capsule.a()) + taxicab3(capsule.b()));
  region.core[0] = 0.5 * length;
  region.radius = capsule.radius();
  return region;
}

ConvexRegion region_of(const Ellipsoid& ellipsoid) {
  ConvexRegion region = around(ellipsoid, RegionShape::rounded, ellipsoid.center(), ellipsoid.axes());
  region.radius = ellipsoid.radii().maxCoeff();
  for (int i = 0; i < 3; ++i) {
    const double r = ellipsoid.radii()[i];
    region.weight[static_cast<std::size_t>(i)] = r > 0 ? region.radius / r : kInfinity;
  }
  return region;
}

}  // namespace

ConvexRegion convex_region(const AnyVolume& volume) {
  return std::visit([](const auto& shape) { return region_of(shape); }, volume);
}

}  // namespace pcl_bv::detail
