// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/float_environment.h"
#include "polytope.h"
#include "projection.h"
#include "ray_clip.h"
#include "shape.h"

namespace pcl_bv {

using namespace detail;

namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("Hull: ") + what);
}

std::vector<Face> faces_of(const Hull& hull) {
  std::vector<Face> faces;
  for (const Hull::Triangle& t : hull.triangles())
    faces.emplace_back(t.begin(), t.end());
  if (hull.rank() == 1 || hull.rank() == 2) {
    Face around;
    for (std::size_t i = 0; i < hull.vertices().size(); ++i)
      around.push_back(static_cast<std::int32_t>(i));
    faces.push_back(around);
    if (hull.rank() == 2) faces.emplace_back(around.rbegin(), around.rend());
  }
  return faces;
}

// Returns the hull relative to its first vertex.
Polytope polytope_of(const Hull& hull) {
  Polytope result;
  result.origin = hull.vertices().front();
  for (const Eigen::Vector3d& v : hull.vertices())
    result.vertices.push_back(v - result.origin);
  result.faces = faces_of(hull);
  return result;
}

// The hull relative to its first vertex, divided by `unit`. The size of `polytope` is then about 1, so that
// products of five lengths do not overflow.
struct Body {
  explicit Body(const Hull& hull) : polytope(polytope_of(hull)), unit(power_of_two_near(polytope.vertices)) {
    for (Eigen::Vector3d& v : polytope.vertices)
      v /= unit;
  }

  Polytope polytope;
  double unit;
};

// Returns an upper bound of normal . (matrix p + shift) over all p of the hull. `transform` consists of
// matrix and shift. `normal` is plane.normal, rotated by the matrix and rounded. With the tiny d = matrix'
// normal - plane.normal, the value is plane.normal . p + d . p + normal . shift. The first term is at most
// plane.offset. The second term is at most d . middle + |d| . half_extents, where `middle` and `half_extents`
// describe a box around the hull.
double moved_offset(const HullPlane& plane, const Eigen::Vector3d& normal, const Eigen::Isometry3d& transform,
                    const Eigen::Vector3d& middle, const Eigen::Vector3d& half_extents) {
  Expansion sum;
  sum.add(plane.offset);
  double spread = 0;
  for (int k = 0; k < 3; ++k) {
    Expansion tilt;
    tilt.add(-plane.normal[k]).add_dot(transform.linear().col(k), normal);
    const double low = tilt.down(), high = tilt.up();
    spread = add_up(spread, multiply_up(std::max(-low, high), half_extents[k]));
    sum.add_product(middle[k] > 0 ? high : low, middle[k]);
    sum.add_product(normal[k], transform(k, 3));
  }
  return sum.add(spread).up();
}

// Returns upper bounds of the projections of the hull on x, y, z, -x, -y, -z, from the planes perpendicular
// to these axes. A bound is infinite if there is no such plane.
std::array<double, 6> axis_bounds(const std::vector<HullPlane>& planes) {
  std::array<double, 6> bounds;
  bounds.fill(kInfinity);
  for (const HullPlane& plane : planes) {
    for (int k = 0; k < 3; ++k) {
      if (plane.normal.cwiseAbs() != Eigen::Vector3d(Eigen::Vector3d::Unit(k))) continue;
      double& bound = bounds[static_cast<std::size_t>(plane.normal[k] > 0 ? k : k + 3)];
      bound = std::min(bound, plane.offset);
    }
  }
  return bounds;
}

}  // namespace

Hull::Hull(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles,
           std::vector<HullPlane> planes, int rank)
    : vertices_(std::move(vertices)),
      triangles_(std::move(triangles)),
      planes_(std::move(planes)),
      rank_(rank) {
  const FloatEnvironment environment;
  require(rank >= 0 && rank <= 3, "rank must be 0 to 3");
  require(vertices_.empty() == planes_.empty(), "vertices and planes must both be given or both be empty");
  for (Eigen::Vector3d& v : vertices_) {
    require(v.allFinite(), "vertices must be finite");
    v = v.array() + 0.0;
  }
  for (HullPlane& p : planes_) {
    require(p.normal.allFinite() && std::isfinite(p.offset), "planes must be finite");
    p.normal = p.normal.array() + 0.0;
    p.offset += 0.0;
  }
  for (const Triangle& t : triangles_) {
    for (const std::int32_t corner : t)
      require(corner >= 0 && static_cast<std::size_t>(corner) < vertices_.size(),
              "a triangle has an index outside the vertices");
  }
}

bool Hull::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  for (const HullPlane& plane : planes_) {
    const auto [s, error] = project(plane.normal, point);
    if (!(s - error <= plane.offset)) return false;
  }
  return !empty() && point.allFinite();
}

double Hull::volume() const {
  const FloatEnvironment environment;
  if (rank_ < 3) return 0;
  const auto [body, unit] = Body(*this);
  return std::max(0.0, measure(body.vertices, body.faces, 3).size) * unit * unit * unit;
}

double Hull::surface_area() const {
  const FloatEnvironment environment;
  if (empty()) return 0;
  const auto [body, unit] = Body(*this);
  return detail::surface_area(body) * unit * unit;
}

Eigen::Vector3d Hull::center() const {
  const FloatEnvironment environment;
  if (empty()) return Eigen::Vector3d::Constant(kNan);
  const auto [body, unit] = Body(*this);
  const Measure m = rank_ >= 2 ? measure(body.vertices, body.faces, rank_) : Measure();
  return body.origin + m.centroid(body.vertices) * unit;
}

Eigen::Vector3d Hull::support(const Eigen::Vector3d& direction) const {
  const FloatEnvironment environment;
  if (empty()) return Eigen::Vector3d::Constant(kNan);
  const Eigen::Vector3d* best = &vertices_.front();
  const Eigen::Vector3d unit = unit_vector(direction);
  double largest = 0;  // relative to the first vertex, so that large coordinates (UTM) cost no digits
  for (const Eigen::Vector3d& v : vertices_) {
    const double projection = project(unit, v - vertices_.front()).value;
    if (projection <= largest) continue;
    largest = projection;
    best = &v;
  }
  return *best;
}

double Hull::distance(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (empty() || !point.allFinite()) return kInfinity;
  if (contains(point)) return 0;
  const Polytope polytope = polytope_of(*this);
  return detail::distance(polytope, point - polytope.origin);
}

std::optional<RayInterval> Hull::intersect(const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction) const {
  return intersect_ray(*this, origin, direction, [&](RayClip& ray) {
    for (const HullPlane& plane : planes_) {
      const Projection start = project(plane.normal, origin), step = project(plane.normal, direction);
      ray.keep(step.low(), plane.offset - start.low());
    }
  });
}

Aabb Hull::aabb() const {
  const FloatEnvironment environment;
  Aabb box;
  for (const Eigen::Vector3d& v : vertices_)
    box.extend(v);
  if (empty()) return box;
  std::array<double, 6> bounds = axis_bounds(planes_);
  if (std::count(bounds.begin(), bounds.end(), kInfinity) > 0) {
    const std::shared_ptr<const SupportShape> shape = make_polytope(*this);
    if (!std::isfinite(shape->size)) return box;
    const Aabb proven = box_of(*shape);
    for (std::size_t side = 0; side < bounds.size(); ++side) {
      const auto k = static_cast<int>(side % 3);
      if (bounds[side] == kInfinity) bounds[side] = side < 3 ? proven.max()[k] : -proven.min()[k];
    }
  }
  box.extend(-Eigen::Vector3d(bounds[3], bounds[4], bounds[5]));
  return box.extend(Eigen::Vector3d(bounds[0], bounds[1], bounds[2]));
}

Mesh Hull::mesh() const {
  if (empty()) return {};
  return {vertices_, faces_of(*this)};
}

Hull Hull::transformed(const Eigen::Isometry3d& transform) const {
  const FloatEnvironment environment;
  Hull moved = *this;
  if (empty()) return moved;
  for (Eigen::Vector3d& v : moved.vertices_)
    v = (transform * v).array() + 0.0;
  const Aabb box = aabb();
  const Eigen::Vector3d middle = box.center();
  Eigen::Vector3d half_extents;
  for (int k = 0; k < 3; ++k)
    half_extents[k] = std::max(add_up(box.max()[k], -middle[k]), add_up(middle[k], -box.min()[k]));
  for (HullPlane& plane : moved.planes_) {
    const Eigen::Vector3d normal = (transform.linear() * plane.normal).array() + 0.0;
    plane = {normal, moved_offset(plane, normal, transform, middle, half_extents) + 0.0};
  }
  return moved;
}

bool operator==(const Hull& a, const Hull& b) {
  const FloatEnvironment environment;
  const auto same = [](const HullPlane& p, const HullPlane& q) {
    return p.normal == q.normal && p.offset == q.offset;
  };
  return a.rank() == b.rank() && a.vertices() == b.vertices() && a.triangles() == b.triangles() &&
         std::equal(a.planes().begin(), a.planes().end(), b.planes().begin(), b.planes().end(), same);
}

}  // namespace pcl_bv
