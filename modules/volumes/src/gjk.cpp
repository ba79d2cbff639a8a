// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "gjk.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "double_double.h"
#include "gjk_simplex.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

Eigen::Vector3d inverse_rotated(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& d) {
  return {dot3(rotation.col(0), d), dot3(rotation.col(1), d), dot3(rotation.col(2), d)};
}

// Tolerances of the two number types.
//
// `margin`: the origin is treated as inside a tetrahedron only if the determinants of any three of its
// vertices exceed `margin`. For double, `margin` exceeds the error of a determinant: coordinates are below 4
// in magnitude, so the sum of six products of three numbers is off by at most 1e-13.
//
// `negligible_length`: shorter lengths are treated as 0.
//
// `rounding`: absolute error of a projection.
template <typename Real>
struct Precision;
template <>
struct Precision<double> {
  static constexpr double margin = 0x1p-36, negligible_length = 0x1p-36, rounding = 0x1p-51;
};
template <>
struct Precision<DoubleDouble> {
  static constexpr double margin = 0, negligible_length = 0x1p-96, rounding = 0x1p-100;
};

// The two functions below return b + delta - a. `a` and `b` are points of the two cores. `delta` is the
// rounded difference of the origins. delta + rest is the exact difference, which only DoubleDouble uses.
Vector<double> difference(const Eigen::Vector3d& delta, const Eigen::Vector3d&, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& a, double) {
  return {delta[0] + (b[0] - a[0]), delta[1] + (b[1] - a[1]), delta[2] + (b[2] - a[2])};
}

Vector<DoubleDouble> difference(const Eigen::Vector3d& delta, const Eigen::Vector3d& rest,
                                const Eigen::Vector3d& b, const Eigen::Vector3d& a, DoubleDouble) {
  Vector<DoubleDouble> result;
  for (int k = 0; k < 3; ++k)
    result[static_cast<std::size_t>(k)] = (exact_sum(delta[k], rest[k]) + exact_sum(b[k], -a[k]));
  return result;
}

class GjkSearch {
 public:
  GjkSearch(const PosedShape& a, const PosedShape& b, Goal goal, double bound)
      : a_(a), b_(b), goal_(goal), bound_(bound), radii_(add_up(a.radius, b.radius)) {
    double extent = std::max(a.size, b.size);
    for (int k = 0; k < 3; ++k) {
      const DoubleDouble apart = exact_sum(b.origin[k], -a.origin[k]);
      delta_[k] = apart.hi;
      delta_rest_[k] = apart.lo;
      extent = std::max(extent, std::abs(delta_[k]));
    }
    // The bodies are treated as overlapping if the cores are the same point, if a number overflows, or if the
    // size of a body is not known.
    overlap_ = !(extent > 0 && std::isfinite(extent) && std::isfinite(radii_));
    if (overlap_) return;
    scale_ = std::ldexp(1.0, -std::max(std::ilogb(extent), -1000));
    const double length = length3(delta_);
    direction_ = length > 0 ? Eigen::Vector3d(delta_ / length) : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  }

  double run() {
    if (overlap_) return 0;
    lower_bound_ = bounding_ball_gap();
    if (!done() && a_.shape.kind == b_.shape.kind && a_.rotation == nullptr && b_.rotation == nullptr) {
      const Gap gap = a_.shape.parallel_gap(b_.shape);
      lower_bound_ = std::max(lower_bound_, gap.bound);
      if (gap.is_exact) return gap.bound;
    }
    if (!done()) search<double>();
    if (!done() && !settled()) search<DoubleDouble>();
    return lower_bound_;
  }

 private:
  bool done() const { return overlap_ || (goal_ == Goal::exceeds_bound && lower_bound_ > bound_); }

  // Returns the distance of the bounding balls around the origins. This lower bound is cheap and decides most
  // pairs of a scene.
  double bounding_ball_gap() const {
    const double radii = add_up(add_up(a_.size, b_.size), radii_);
    const double apart = length3(delta_) * (1 - 0x1p-49) - radii;
    return apart > 0 ? apart * (1 - 0x1p-52) : 0;
  }

  // Returns whether the lower and upper bounds agree up to rounding, so that more digits would not help.
  bool settled() const {
    const double sizes = (a_.size + b_.size) + radii_;
    return upper_bound_ - radii_ - lower_bound_ <= 0x1p-42 * upper_bound_ + 0x1p-46 * sizes;
  }

  // Returns a proven lower bound of the distance, computed from the gap along d. The length of d must be
  // about 1. Returns 0 if d does not separate the bodies. With U = 2^-53, delta is off by at most U of
  // itself, the products and sums by 3.01 U of their terms, and each further step by U of its result.
  double certified(const Eigen::Vector3d& d) const {
    const double x = d[0] * delta_[0], y = d[1] * delta_[1], z = d[2] * delta_[2];
    const double support_a = a_.support_value_up(d), support_b = b_.support_value_up(-d);
    const double terms =
        ((std::abs(x) + std::abs(y)) + std::abs(z)) + (std::abs(support_a) + std::abs(support_b));
    const double gap = (((x + y) + z) - support_a) - support_b - 0x1p-50 * terms;
    if (!(gap > 0)) return 0;
    const double apart = gap / norm3(d) * (1 - 0x1p-50) - radii_;
    return apart > 0 ? apart * (1 - 0x1p-52) : 0;
  }

  void prove(const Eigen::Vector3d& d) { lower_bound_ = std::max(lower_bound_, certified(d)); }

  // Returns the point of the Minkowski difference b - a with the smallest projection on d, multiplied by
  // scale_.
  template <typename Real>
  Vector<Real> support(const Eigen::Vector3d& d) const {
    const Vector<Real> w = difference(delta_, delta_rest_, b_.support(-d), a_.support(d), Real());
    return times(Real(scale_), w);
  }

  // Runs the iteration. The iteration ends if the points of the simplex prove that no direction is better, if
  // rounding prevents further progress, if done() is true, or after 100 steps.
  template <typename Real>
  void search() {
    using P = Precision<Real>;
    Simplex<Real> simplex;
    Eigen::Vector3d d = direction_;
    double best = -kInfinity, upper = kInfinity;
    for (int step = 0; step < 100; ++step) {
      const Vector<Real> w = support<Real>(d);
      const double gap = static_cast<double>(inner(w, Vector<Real>{Real(d[0]), Real(d[1]), Real(d[2])}));
      if (gap > best) direction_ = d;
      best = std::max(best, gap);
      if (gap / scale_ - radii_ > bound_ && !(lower_bound_ > bound_)) prove(d);
      if (done()) return;
      const bool reached = upper < kInfinity && upper - gap <= 0x1p-44 * upper + P::rounding;
      if (reached || simplex.has(w)) break;
      simplex.add(w);
      const auto foot = simplex.reduce(P::margin);
      if (!foot) {
        overlap_ = !(lower_bound_ > 0);
        return;
      }
      const double length = std::sqrt(static_cast<double>(inner(*foot, *foot)));
      if (!(length < upper)) break;
      upper = length;
      if (near_enough(length)) return;
      if (length < P::negligible_length) break;
      for (std::size_t k = 0; k < 3; ++k)
        d[static_cast<int>(k)] = static_cast<double>((*foot)[k]) / length;
    }
    upper_bound_ = std::min(upper_bound_, upper / scale_);
    prove(direction_);
  }

  // Returns whether two points of the cores, `length` apart after scaling, prove that the bodies overlap by
  // more than rounding errors. With Goal::exceeds_bound, returns whether these points prove that the distance
  // of the bodies is below the bound by more than rounding errors.
  bool near_enough(double length) {
    if (goal_ == Goal::distance && lower_bound_ > 0) return false;
    overlap_ = length / scale_ * (1 + 0x1p-40) < radii_ + (goal_ == Goal::exceeds_bound ? bound_ : 0);
    return overlap_;
  }

  const PosedShape &a_, &b_;
  const Goal goal_;
  const double bound_, radii_;
  Eigen::Vector3d delta_, delta_rest_;
  double scale_ = 1;                // power of two that scales lengths to about 1
  Eigen::Vector3d direction_;       // initial direction, then the best direction of a search
  bool overlap_ = false;            // the bodies overlap or are nearer than bound_
  double lower_bound_ = 0;          // best proven lower bound of the distance
  double upper_bound_ = kInfinity;  // smallest distance found between points of the cores
};

// Returns the numbers by which lower_bound() orders two bodies, so that the order of its arguments does not
// matter.
auto key(const PosedShape& p) {
  const Eigen::Vector3d order_key = p.shape.order_key();
  return std::array{static_cast<double>(p.shape.kind),
                    p.origin[0],
                    p.origin[1],
                    p.origin[2],
                    p.radius,
                    p.size,
                    order_key[0],
                    order_key[1],
                    order_key[2]};
}

}  // namespace

PosedShape::PosedShape(const ConvexBody& body)
    : shape(*body.shape_),
      rotation(body.is_rotated_ ? &body.rotation_ : nullptr),
      origin(body.origin_),
      size(body.size_),
      radius(body.radius_) {}

PosedShape::PosedShape(const SupportShape& point, const Eigen::Vector3d& at)
    : shape(point), rotation(nullptr), origin(at), size(0), radius(0) {}

Eigen::Vector3d PosedShape::support(const Eigen::Vector3d& d) const {
  if (rotation == nullptr) return shape.support(d);
  const Eigen::Vector3d q = shape.support(inverse_rotated(*rotation, d));
  return {dot3(rotation->row(0), q), dot3(rotation->row(1), q), dot3(rotation->row(2), q)};
}

// Uses d . (rotation q) = (rotation' d) . q. With U = 2^-53, the rounding error of rotation' d is below 4 U
// of its terms.
double PosedShape::support_value_up(const Eigen::Vector3d& d) const {
  if (rotation == nullptr) return shape.support_value_up(d);
  double terms = 0;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i)
      terms += std::abs((*rotation)(i, j) * d[i]);
  }
  const double value = shape.support_value_up(inverse_rotated(*rotation, d));
  const double lost = 0x1p-51 * terms * shape.size + kSmallestNormal;
  return value + lost + 0x1p-51 * (std::abs(value) + lost);
}

double lower_bound(const PosedShape& a, const PosedShape& b, Goal goal, double bound) {
  return key(b) < key(a) ? GjkSearch(b, a, goal, bound).run() : GjkSearch(a, b, goal, bound).run();
}

}  // namespace pcl_bv::detail
