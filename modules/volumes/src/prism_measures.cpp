// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sizes of a prism, and points on it.

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/prism.h"
#include "pcl_bv/volumes/simple_polygon.h"
#include "prism_polygon.h"

namespace pcl_bv {

using namespace detail;

namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The outline relative to its first corner, divided by a power of two. Its size is then about 1, so that
// products of three lengths neither overflow nor underflow.
struct Polygon {
  explicit Polygon(const Prism& prism) {
    const Eigen::Vector2d& origin = prism.outline().front();
    double size = 0;
    for (const Eigen::Vector2d& corner : prism.outline())
      size = std::max(size, (corner - origin).cwiseAbs().maxCoeff());
    if (size > 0) unit = std::ldexp(1.0, std::max(std::ilogb(size), -1000));
    for (const Eigen::Vector2d& corner : prism.outline())
      corners.emplace_back((corner - origin) / unit);
  }

  const Eigen::Vector2d& next(std::size_t i) const { return corners[i + 1 < corners.size() ? i + 1 : 0]; }

  double area() const {
    double twice = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      twice += cross(corners[i], next(i));
    return std::max(0.0, twice / 2);
  }

  double perimeter() const {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      sum += (next(i) - corners[i]).norm();
    return sum;
  }

  // Returns the centre of mass or, if the area is 0, the mean of the corners.
  Eigen::Vector2d centroid() const {
    double area = 0;
    Eigen::Vector2d moment = Eigen::Vector2d::Zero(), mean = moment;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const double part = cross(corners[i], next(i));
      area += part;
      moment += part / 3 * (corners[i] + next(i));
      mean += corners[i] / static_cast<double>(corners.size());
    }
    return area > 0 ? Eigen::Vector2d(moment / area) : mean;
  }

  std::vector<Eigen::Vector2d> corners;
  double unit = 1;
};

// Returns the point with the coordinates `at` along the axes. The second round corrects for axes that are not
// exactly orthogonal, and for the rounding of the first one, which is relative to the largest coordinate. The
// exact sum leaves an error of about one unit in the last place of each coordinate.
Eigen::Vector3d position(const Eigen::Matrix3d& axes, const Eigen::Vector3d& at) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (int round = 0; round < 2; ++round) {
    Eigen::Vector3d missing;
    for (int i = 0; i < 3; ++i)
      missing[i] = Expansion().add(at[i]).add_dot(Eigen::Vector3d(-axes.col(i)), p).value();
    p += (axes.col(0) * missing[0] + axes.col(1) * missing[1]) + axes.col(2) * missing[2];
  }
  return p.array() + 0.0;
}

// Returns the distance of a point of the plane from the nearest edge of the outline.
double distance_to_edges(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& p) {
  const std::size_t count = outline.size();
  double nearest = kInfinity;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d edge = outline[i + 1 < count ? i + 1 : 0] - outline[i], from = p - outline[i];
    const double length = edge.stableNorm();
    const Eigen::Vector2d unit = edge.stableNormalized();  // zero for an edge of length 0
    const double along = std::clamp(unit.x() * from.x() + unit.y() * from.y(), 0.0, length);
    nearest = std::min(nearest, (from - along * unit).stableNorm());
  }
  return nearest;
}

// Returns whether the point is inside all half-planes of a convex outline, up to rounding.
bool is_in_convex(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& p) {
  const std::size_t count = outline.size();
  bool inside = count > 2;
  for (std::size_t i = 0; i < count && inside; ++i) {
    const Eigen::Vector2d edge = outline[i + 1 < count ? i + 1 : 0] - outline[i], from = p - outline[i];
    inside = cross(edge.stableNormalized(), from) >= 0;
  }
  return inside;
}

// Appends bottom and top as triangles.
void add_triangular_ends(const std::vector<Eigen::Vector2d>& outline, Mesh& mesh) {
  const auto count = static_cast<std::int32_t>(outline.size());
  for (const auto& triangle : triangles_of(outline)) {
    const auto a = static_cast<std::int32_t>(triangle[0]), b = static_cast<std::int32_t>(triangle[1]),
               c = static_cast<std::int32_t>(triangle[2]);
    mesh.faces.push_back({c, b, a});
    mesh.faces.push_back({a + count, b + count, c + count});
  }
}

}  // namespace

double Prism::footprint_area() const {
  const FloatEnvironment environment;
  if (empty()) return 0;
  const Polygon polygon(*this);
  return polygon.area() * polygon.unit * polygon.unit;
}

std::vector<Eigen::Vector3d> Prism::footprint() const {
  const FloatEnvironment environment;
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector2d& corner : outline_)
    corners.push_back(position(axes_, {corner.x(), corner.y(), low_}));
  return corners;
}

double Prism::volume() const {
  const FloatEnvironment environment;
  if (empty()) return 0;
  const Polygon polygon(*this);
  // The height comes between the two units, because their product can vanish or overflow before it.
  return polygon.area() * polygon.unit * (high_ - low_) * polygon.unit;
}

double Prism::surface_area() const {
  const FloatEnvironment environment;
  if (empty()) return 0;
  const Polygon polygon(*this);
  return 2 * polygon.area() * polygon.unit * polygon.unit +
         polygon.perimeter() * polygon.unit * (high_ - low_);
}

Eigen::Vector3d Prism::center() const {
  const FloatEnvironment environment;
  if (empty()) return Eigen::Vector3d::Constant(kNan);
  const Polygon polygon(*this);
  const Eigen::Vector2d middle = outline_.front() + polygon.centroid() * polygon.unit;
  return position(axes_, {middle.x(), middle.y(), low_ + 0.5 * (high_ - low_)});
}

Eigen::Vector3d Prism::support(const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  if (empty()) return Eigen::Vector3d::Constant(kNan);
  const Eigen::Vector3d unit = direction.stableNormalized();
  const double x = dot3(axes_.col(0), unit), y = dot3(axes_.col(1), unit), z = dot3(axes_.col(2), unit);
  const Eigen::Vector2d* best = &outline_.front();
  double largest = 0;  // relative to the first corner, so that large coordinates (UTM) cost no digits
  for (const Eigen::Vector2d& corner : outline_) {
    const Eigen::Vector2d q = corner - outline_.front();
    const double projection = q.x() * x + q.y() * y;
    if (projection <= largest) continue;
    largest = projection;
    best = &corner;
  }
  return position(axes_, {best->x(), best->y(), z < 0 ? low_ : high_});
}

double Prism::distance(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (empty() || !point.allFinite()) return kInfinity;
  if (contains(point)) return 0;
  const double h = dot3(axes_.col(2), point);
  const double vertical = std::max({0.0, low_ - h, h - high_});
  const Projection u = project(axes_.col(0), point), v = project(axes_.col(1), point);
  const Eigen::Vector2d at(u.value, v.value);
  const bool in_outline = is_convex_ ? is_in_convex(outline_, at) : polygon_contains(PrismSides(*this), u, v);
  const double horizontal = in_outline ? 0 : distance_to_edges(outline_, at);
  return Eigen::Vector2d(vertical, horizontal).stableNorm();
}

Mesh Prism::mesh() const {
  const FloatEnvironment environment;
  Mesh mesh;
  const auto count = static_cast<std::int32_t>(outline_.size());
  for (const double h : {low_, high_}) {
    for (const Eigen::Vector2d& corner : outline_)
      mesh.vertices.push_back(position(axes_, {corner.x(), corner.y(), h}));
  }
  std::vector<std::int32_t> bottom, top;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t next = (i + 1) % count;
    mesh.faces.push_back({i, next, next + count, i + count});
    bottom.push_back(count - 1 - i);
    top.push_back(count + i);
  }
  if (count == 1) mesh.faces = {{0, 1}};
  if (count > 2 && is_convex_) mesh.faces.insert(mesh.faces.end(), {bottom, top});
  if (!is_convex_) add_triangular_ends(outline_, mesh);
  return mesh;
}

}  // namespace pcl_bv
