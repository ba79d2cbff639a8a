// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/prism.h"

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
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/obb.h"
#include "pcl_bv/volumes/outline.h"
#include "pcl_bv/volumes/simple_polygon.h"
#include "prism_polygon.h"
#include "prism_sides.h"
#include "projection.h"
#include "ray_clip.h"
#include "shape.h"

namespace pcl_bv {

using namespace detail;

namespace {

void check_prism(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("Prism: ") + what);
}

// Returns a simple polygon that contains every polygon whose corners are in the boxes, in their order or, if
// `reversed`, in the opposite order. Returns nothing if rounding leaves no such polygon, or a convex one.
std::optional<std::vector<Eigen::Vector2d>> polygon_around_boxes(const std::vector<PlaneBox>& boxes,
                                                                 bool reversed) {
  std::vector<Eigen::Vector2d> corners;
  double widest = 0;
  for (const PlaneBox& box : boxes) {
    corners.push_back(box.low);
    for (int k = 0; k < 2; ++k)
      widest = std::max(widest, add_up(box.high[k], -box.low[k]));
  }
  if (reversed) std::reverse(corners.begin(), corners.end());
  corners = without_straight_corners(corners);
  if (!is_simple_polygon(corners)) return std::nullopt;
  std::optional<std::vector<Eigen::Vector2d>> around = polygon_around(corners, widest);
  if (around && is_strictly_convex(*around)) return std::nullopt;
  return around;
}

// Returns whether each axis is parallel to a coordinate axis. Axes that are orthonormal to 1e-12 are then a
// permutation of the coordinate axes, up to their signs.
bool is_permutation(const Eigen::Matrix3d& axes) {
  return (axes.array() == 0 || axes.cwiseAbs().array() == 1).all();
}

// Upper bound of |p - center| over all p of the prism. The factor covers axes that are not exactly
// orthonormal, and the rounding of the centre.
double radius_up(const Prism& prism) {
  const PrismSides sides(prism);
  const Eigen::Vector3d size(add_up(sides.high().x(), -sides.low().x()),
                             add_up(sides.high().y(), -sides.low().y()), add_up(prism.high(), -prism.low()));
  const Eigen::Vector3d farthest(sides.low().cwiseAbs().cwiseMax(sides.high().cwiseAbs()).maxCoeff(),
                                 std::abs(prism.low()), std::abs(prism.high()));
  return 1.001 * (norm_up(size) + 0x1p-48 * taxicab3(farthest)) + kSmallestNormal;
}

// How a transform M p + t moves one coordinate. Let a be the old axis, a' the new axis and c the centre. With
// d = M' a' - sign a, which is tiny, the new coordinate a' . (M p + t) is sign (a . p) + a' . t + d . c +
// d . (p - c). The last term is the error, together with the rounding of d.
class MovedAxis {
 public:
  MovedAxis(const Eigen::Isometry3d& transform, const Eigen::Vector3d& old_axis,
            const Eigen::Vector3d& new_axis, double sign, const Eigen::Vector3d& center, double radius)
      : sign_(sign) {
    Eigen::Vector3d d;
    for (int k = 0; k < 3; ++k) {
      Expansion tilt;
      d[k] = tilt.add(-sign * old_axis[k]).add_dot(transform.linear().col(k), new_axis).value();
      const double rounding = tilt.add(-d[k]).magnitude_up();
      error_ = add_up(error_, multiply_up(rounding, add_up(std::abs(center[k]), radius)));
      shift_.add_product(new_axis[k], transform(k, 3)).add_product(d[k], center[k]);
    }
    error_ = add_up(error_, multiply_up(norm_up(d), radius));
  }

  double down(double coordinate) const { return at(coordinate).add(-error_).down() + 0.0; }
  double up(double coordinate) const { return at(coordinate).add(error_).up() + 0.0; }

 private:
  Expansion at(double coordinate) const { return Expansion(shift_).add(sign_ * coordinate); }

  double sign_;
  double error_ = 0;
  Expansion shift_;
};

}  // namespace

Prism::Prism() : axes_(Eigen::Matrix3d::Identity()), low_(kInfinity), high_(-kInfinity) {}

Prism::Prism(const Eigen::Matrix3d& axes, std::vector<Eigen::Vector2d> outline, double low, double high)
    : Prism() {
  const FloatEnvironment environment;
  if (outline.empty() || low > high) return;
  check_prism(std::isfinite(low) && std::isfinite(high), "low and high must be finite");
  check_prism(orthonormality_error(axes) <= 1e-12 && dot3(cross3(axes.col(0), axes.col(1)), axes.col(2)) > 0,
              "axes must be right-handed and orthonormal to 1e-12");
  for (Eigen::Vector2d& corner : outline) {
    check_prism(corner.allFinite() && corner.cwiseAbs().maxCoeff() <= 1e101,
                "corners must be finite, within 1e101");
    corner = corner.array() + 0.0;
  }
  const bool is_convex = is_strictly_convex(outline);
  check_prism(
      is_convex || is_simple_polygon(outline),
      "the outline must be a polygon, counter-clockwise, whose edges meet only at the corners they share, "
      "and with no three neighbouring corners on a line");
  *this = PrismAccess::make(axes.array() + 0.0, std::move(outline), low + 0.0, high + 0.0, is_convex);
}

bool Prism::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (empty() || !(point.cwiseAbs().maxCoeff() <= 1e120) || !point.allFinite()) return false;
  const Projection h = project(axes_.col(2), point);
  if (!(h.value + h.error >= low_ && h.value - h.error <= high_)) return false;
  const Projection u = project(axes_.col(0), point), v = project(axes_.col(1), point);
  const PrismSides sides(*this);
  const auto between = [](const Projection& p, double low, double high) {
    return p.value + p.error >= low && p.value - p.error <= high;
  };
  if (!between(u, sides.low().x(), sides.high().x()) || !between(v, sides.low().y(), sides.high().y()))
    return false;
  if (!is_convex_) return polygon_contains(sides, u, v);
  return sides.all_of([&](const Eigen::Vector2d& corner, const Eigen::Vector2d& edge) {
    const SideValue side = PrismSides::cross(edge, relative(u, corner.x()), relative(v, corner.y()));
    return side.value + side.error >= 0;
  });
}

std::optional<RayInterval> Prism::intersect(const Eigen::Vector3d& origin,
                                            const Eigen::Vector3d& direction) const {
  return intersect_ray(*this, origin, direction, [&](RayClip& ray) {
    const auto keep_between = [&](const Projection& start, const Projection& step, double low, double high) {
      ray.keep(step.low(), high - start.low());
      ray.keep(-step.high(), start.high() - low);
    };
    const auto along = [&](int i, const Eigen::Vector3d& p) { return project(axes_.col(i), p); };
    const auto widened = [](const Projection& p) { return Projection{p.value, 2 * p.error}; };
    keep_between(along(2, origin), along(2, direction), low_, high_);
    const Projection u = widened(along(0, origin)), v = widened(along(1, origin));
    const Projection du = widened(along(0, direction)), dv = widened(along(1, direction));
    const PrismSides sides(*this);
    keep_between(u, du, sides.low().x(), sides.high().x());
    keep_between(v, dv, sides.low().y(), sides.high().y());
    if (!is_convex_) return clip_to_polygon(sides, {{u, v}, {du, dv}}, ray);
    sides.all_of([&](const Eigen::Vector2d& corner, const Eigen::Vector2d& edge) {
      const SideValue start = PrismSides::cross(edge, relative(u, corner.x()), relative(v, corner.y()));
      const SideValue step = PrismSides::cross(edge, du, dv);
      ray.keep(-step.value - 2 * step.error, start.value + 2 * start.error);
      return true;
    });
  });
}

Aabb Prism::aabb() const {
  const FloatEnvironment environment;
  if (empty()) return {};
  if (!is_permutation(axes_)) return box_of(*make_polytope(*this));
  const PrismSides sides(*this);
  const Eigen::Vector3d low(sides.low().x(), sides.low().y(), low_),
      high(sides.high().x(), sides.high().y(), high_);
  Aabb box;
  for (const Eigen::Vector3d& corner : {low, high})
    box.extend(Eigen::Vector3d((axes_ * corner).array() + 0.0));  // exact: one product of each sum is not 0
  return box;
}

Prism Prism::transformed(const Eigen::Isometry3d& transform) const {
  const FloatEnvironment environment;
  if (empty()) return {};
  const Eigen::Matrix3d m = transform.linear();
  Eigen::Matrix3d from_up;
  from_up << m * axes_.col(2), m * axes_.col(0), m * axes_.col(1);
  const Eigen::Matrix3d turned = orthonormal_axes(from_up);
  Eigen::Matrix3d axes;
  axes << turned.col(1), turned.col(2), turned.col(0);
  axes.array() += 0.0;
  // A reflection would make the axes left-handed, so it negates the second coordinate.
  const double mirror = dot3(axes.col(1), m * axes_.col(1)) < 0 ? -1 : 1;
  const Eigen::Vector3d middle = center();
  const double radius = radius_up(*this);
  const auto moved = [&](int i, double sign) {
    return MovedAxis(transform, axes_.col(i), axes.col(i), sign, middle, radius);
  };
  const MovedAxis u = moved(0, 1), v = moved(1, mirror), h = moved(2, 1);
  std::vector<PlaneBox> boxes;
  for (const Eigen::Vector2d& corner : outline_)
    boxes.push_back({{u.down(corner.x()), v.down(corner.y())}, {u.up(corner.x()), v.up(corner.y())}});
  std::optional<std::vector<Eigen::Vector2d>> concave;
  if (!is_convex_) concave = polygon_around_boxes(boxes, mirror < 0);
  const bool is_convex = !concave;
  return PrismAccess::make(axes, is_convex ? outline_around(boxes) : *std::move(concave), h.down(low_),
                           h.up(high_), is_convex);
}

bool operator==(const Prism& a, const Prism& b) {
  const FloatEnvironment environment;
  return a.axes() == b.axes() && a.outline() == b.outline() && a.low() == b.low() && a.high() == b.high();
}

}  // namespace pcl_bv
