// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/expansion.h"
#include "shape.h"
#include "skew_axes.h"

namespace pcl_bv::detail {
namespace {

// A prism relative to its centre. The local coordinates of its corners have a relative error of 2^-52.
class PrismShape final : public SupportShape {
 public:
  explicit PrismShape(const Prism& prism) : axes_(prism.axes()), dual_(dual(axes_)) {
    origin = prism.center();
    const auto local = [&](int i, double coordinate) {
      return Expansion().add(coordinate).add_dot(Eigen::Vector3d(-axes_.col(i)), origin).value();
    };
    for (const Eigen::Vector2d& corner : prism.outline()) {
      u_.push_back(local(0, corner.x()));
      v_.push_back(local(1, corner.y()));
      max_abs_[0] = std::max(max_abs_[0], std::abs(u_.back()));
      max_abs_[1] = std::max(max_abs_[1], std::abs(v_.back()));
    }
    low_ = local(2, prism.low());
    high_ = local(2, prism.high());
    max_abs_[2] = std::max(std::abs(low_), std::abs(high_));
    size = length3(max_abs_) * kSkewFactor;
  }

  Eigen::Vector3d support(const Eigen::Vector3d& d) const override {
    const std::size_t i = farthest(dot3(dual_.col(0), d), dot3(dual_.col(1), d));
    return linear_combination(dual_, {u_[i], v_[i], dot3(dual_.col(2), d) < 0 ? low_ : high_});
  }

  double support_value_up(const Eigen::Vector3d& d) const override {
    const auto [y, residual] = Components(axes_, d);
    const std::size_t i = farthest(y[0], y[1]);
    const double value = (y[0] * u_[i] + y[1] * v_[i]) + y[2] * (y[2] < 0 ? low_ : high_);
    const double terms =
        (std::abs(y[0]) * max_abs_[0] + std::abs(y[1]) * max_abs_[1]) + std::abs(y[2]) * max_abs_[2];
    // The rounding of farthest() can choose a corner whose projection is smaller than the largest one by
    // 2^-51 of the terms.
    return value + (0x1p-49 * terms + residual * size * (1 + 0x1p-50) + kSmallestNormal);
  }

  Eigen::Vector3d order_key() const override { return {u_.front(), v_.front(), high_}; }

 private:
  // Returns the corner with the largest projection x u + y v.
  std::size_t farthest(double x, double y) const {
    std::size_t best = 0;
    double largest = -kInfinity;
    for (std::size_t i = 0; i < u_.size(); ++i) {
      const double projection = x * u_[i] + y * v_[i];
      if (!(projection > largest)) continue;
      largest = projection;
      best = i;
    }
    return best;
  }

  Eigen::Matrix3d axes_, dual_;
  std::vector<double> u_, v_;
  double low_, high_;
  Eigen::Vector3d max_abs_ = Eigen::Vector3d::Zero();
};

}  // namespace

std::shared_ptr<SupportShape> make_polytope(const Prism& prism) {
  return std::make_shared<PrismShape>(prism);
}

}  // namespace pcl_bv::detail
