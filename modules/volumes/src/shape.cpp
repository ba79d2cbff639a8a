// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The shapes of all kinds of volumes except k-DOPs, hulls and prisms. With U = 2^-53, three products and two
// sums are off by at most 3.01 U of the sum of the products' magnitudes. The error bounds are 8 U = 2^-50 of
// this sum, plus the smallest normal number. The factor of 8 U also covers the rounding when an error bound
// is added. The smallest normal number covers underflow.
#include "shape.h"

#include <algorithm>
#include <cmath>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"
#include "skew_axes.h"

namespace pcl_bv::detail {

double length3(const Eigen::Vector3d& v) {
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  if (largest > 0x1p-400 && largest < 0x1p400) return norm3(v);
  if (!(largest > 0) || !std::isfinite(largest)) return largest;
  const double unit = largest < 1 ? 0x1p600 : 0x1p-600;
  return norm3(Eigen::Vector3d(v * unit)) / unit;
}

namespace {

class AabbShape final : public SupportShape {
 public:
  explicit AabbShape(const Aabb& box) : box_(box) {
    origin = 0.5 * box.min() + 0.5 * box.max();
    Eigen::Vector3d farthest;
    for (int k = 0; k < 3; ++k) {
      low_[k] = -add_up(origin[k], -box.min()[k]);
      high_[k] = add_up(box.max()[k], -origin[k]);
      farthest[k] = std::max(high_[k], -low_[k]);
    }
    size = norm_up(farthest);
  }

  Eigen::Vector3d support(const Eigen::Vector3d& d) const override {
    return {d[0] < 0 ? low_[0] : high_[0], d[1] < 0 ? low_[1] : high_[1], d[2] < 0 ? low_[2] : high_[2]};
  }

  double support_value_up(const Eigen::Vector3d& d) const override {
    const Eigen::Vector3d p = support(d);
    const double x = d[0] * p[0], y = d[1] * p[1], z = d[2] * p[2];
    return ((x + y) + z) + (0x1p-50 * ((std::abs(x) + std::abs(y)) + std::abs(z)) + kSmallestNormal);
  }

  // Computes the distance from the gaps along the three axes and rounds it down.
  Gap parallel_gap(const SupportShape& other) const override {
    const Aabb& b = static_cast<const AabbShape&>(other).box_;
    Eigen::Vector3d gap;
    for (int k = 0; k < 3; ++k) {
      gap[k] = 0;
      if (b.min()[k] > box_.max()[k]) gap[k] = -add_up(box_.max()[k], -b.min()[k]);
      if (box_.min()[k] > b.max()[k]) gap[k] = -add_up(b.max()[k], -box_.min()[k]);
    }
    return {std::max({gap[0], gap[1], gap[2], length3(gap) * (1 - 0x1p-50)}), true};
  }

  Eigen::Vector3d order_key() const override { return high_; }

 private:
  Aabb box_;
  Eigen::Vector3d low_, high_;
};

class ObbShape final : public SupportShape {
 public:
  explicit ObbShape(const Obb& box) : axes_(box.axes()), dual_(dual(axes_)), half_(box.half_extents()) {
    origin = box.center();
    size = length3(half_) * kSkewFactor;
  }

  Eigen::Vector3d support(const Eigen::Vector3d& d) const override {
    Eigen::Vector3d s;
    for (int i = 0; i < 3; ++i)
      s[i] = dot3(dual_.col(i), d) < 0 ? -half_[i] : half_[i];
    return linear_combination(dual_, s);
  }

  double support_value_up(const Eigen::Vector3d& d) const override {
    const auto [y, residual] = Components(axes_, d);
    const double value = (std::abs(y[0]) * half_[0] + std::abs(y[1]) * half_[1]) + std::abs(y[2]) * half_[2];
    return value * (1 + 0x1p-50) + (residual * size * (1 + 0x1p-50) + kSmallestNormal);
  }

  Eigen::Vector3d order_key() const override { return half_; }

 private:
  Eigen::Matrix3d axes_, dual_;
  Eigen::Vector3d half_;
};

// Bound of the support value: let s_i = axis i . q. Then sum y_i s_i = sum (y_i r_i)(s_i / r_i) <= |(y_i
// r_i)| by the Cauchy-Schwarz inequality, since |(s_i / r_i)| <= 1.
class EllipsoidShape final : public SupportShape {
 public:
  explicit EllipsoidShape(const Ellipsoid& e) : axes_(e.axes()), dual_(dual(axes_)), radii_(e.radii()) {
    origin = e.center();
    size = std::max({radii_[0], radii_[1], radii_[2]}) * kSkewFactor;
  }

  Eigen::Vector3d support(const Eigen::Vector3d& d) const override {
    Eigen::Vector3d s;
    for (int i = 0; i < 3; ++i)
      s[i] = radii_[i] * dot3(dual_.col(i), d);
    const double length = length3(s);
    if (!(length > 0)) return Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i)
      s[i] = radii_[i] * (s[i] / length);
    return linear_combination(dual_, s);
  }

  double support_value_up(const Eigen::Vector3d& d) const override {
    const auto [y, residual] = Components(axes_, d);
    const double value = length3({y[0] * radii_[0], y[1] * radii_[1], y[2] * radii_[2]});
    return value * (1 + 0x1p-49) + (residual * size * (1 + 0x1p-50) + kSmallestNormal);
  }

  Eigen::Vector3d order_key() const override { return radii_; }

 private:
  Eigen::Matrix3d axes_, dual_;
  Eigen::Vector3d radii_;
};

// Bound of the support value: let u be the axis. Each point is q = t u + v with |t| <= h / |u|, v
// perpendicular to u and |v| <= r. Therefore d . q <= (h |d . u| + r |d x u|) / |u|, where |u| differs from 1
// by at most 2^-50. The error of d . u is below 4 U |d|, the error of d x u is below 6 U |d|.
class CylinderShape final : public SupportShape {
 public:
  explicit CylinderShape(const Cylinder& c)
      : axis_(c.axis()), core_radius_(c.radius()), half_height_(c.half_height()) {
    origin = c.center();
    size = length3({core_radius_, half_height_, 0}) * kSkewFactor;
  }

  Eigen::Vector3d support(const Eigen::Vector3d& d) const override {
    const double along = dot3(axis_, d);
    const Eigen::Vector3d perpendicular = cross3(axis_, cross3(d, axis_));  // accurate even if it is tiny
    const double length = length3(perpendicular);
    Eigen::Vector3d end = (along < 0 ? -half_height_ : half_height_) * axis_;
    if (!(length > 0)) return end;
    return end + core_radius_ * Eigen::Vector3d(perpendicular / length);
  }

  double support_value_up(const Eigen::Vector3d& d) const override {
    const double value = half_height_ * std::abs(dot3(axis_, d)) + core_radius_ * length3(cross3(axis_, d));
    return value * (1 + 0x1p-48) + (0x1p-49 * (half_height_ + core_radius_) * taxicab3(d) + kSmallestNormal);
  }

  Eigen::Vector3d order_key() const override { return axis_; }

 private:
  Eigen::Vector3d axis_;
  double core_radius_, half_height_;
};

// The shape of capsules, spheres and points. a_ and b_, the ends relative to the origin, are rounded once.
class SegmentShape final : public SupportShape {
 public:
  SegmentShape(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double around) {
    radius = around;
    origin = a == b ? a : Eigen::Vector3d(0.5 * a + 0.5 * b);
    a_ = a - origin;
    b_ = b - origin;
    for (int k = 0; k < 3; ++k)
      max_abs_[k] = std::max(std::abs(a_[k]), std::abs(b_[k]));
    size = length3(max_abs_) * kSkewFactor;
  }

  Eigen::Vector3d support(const Eigen::Vector3d& d) const override {
    return dot3(a_, d) < dot3(b_, d) ? b_ : a_;
  }

  double support_value_up(const Eigen::Vector3d& d) const override {
    const Eigen::Vector3d magnitude(std::abs(d[0]), std::abs(d[1]), std::abs(d[2]));
    return std::max(dot3(a_, d), dot3(b_, d)) + (0x1p-50 * dot3(magnitude, max_abs_) + kSmallestNormal);
  }

  Eigen::Vector3d order_key() const override { return a_; }

 private:
  Eigen::Vector3d a_, b_, max_abs_;
};

struct Maker {
  using Result = std::shared_ptr<SupportShape>;

  Result operator()(const Aabb& v) const { return std::make_shared<AabbShape>(v); }
  Result operator()(const Kdop& v) const { return make_polytope(v); }
  Result operator()(const Sphere& v) const {
    return std::make_shared<SegmentShape>(v.center(), v.center(), v.radius());
  }
  Result operator()(const Obb& v) const { return std::make_shared<ObbShape>(v); }
  Result operator()(const Cylinder& v) const { return std::make_shared<CylinderShape>(v); }
  Result operator()(const Capsule& v) const {
    return std::make_shared<SegmentShape>(v.a(), v.b(), v.radius());
  }
  Result operator()(const Ellipsoid& v) const { return std::make_shared<EllipsoidShape>(v); }
  Result operator()(const Hull& v) const { return make_polytope(v); }
  Result operator()(const Prism& v) const { return make_polytope(v); }
};

}  // namespace

std::shared_ptr<SupportShape> make_shape(const AnyVolume& volume) {
  if (empty(volume)) return nullptr;
  std::shared_ptr<SupportShape> shape = std::visit(Maker(), volume);
  if (shape) shape->kind = static_cast<int>(volume.index());
  return shape;
}

Aabb box_of(const SupportShape& shape) {
  const auto support_value = [&](int k, double sign) {
    return add_up(shape.support_value_up(sign * Eigen::Vector3d::Unit(k)), sign * shape.origin[k]);
  };
  return {-Eigen::Vector3d(support_value(0, -1), support_value(1, -1), support_value(2, -1)),
          {support_value(0, 1), support_value(1, 1), support_value(2, 1)}};
}

}  // namespace pcl_bv::detail
