// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bounds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

// Squares of values between 2^-400 and 2^400 are well inside the range of double. Smaller values are
// multiplied by 2^600 first.
constexpr double kSmallExtent = 0x1p-400;
constexpr double kLift = 0x1p600;

// Adds sign * (a - b)^2 exactly. With the rounded difference d and its rounding error e, a - b = d + e. So
// the terms are d^2, 2 d e and e^2.
void add_square_of_difference(Expansion& sum, double a, double b, double sign) {
  const double d = a - b;
  const double e = Expansion().add(a).add(-b).add(-d).value();
  sum.add_product(sign * d, d).add_product(sign * 2 * d, e).add_product(sign * e, e);
}

}  // namespace

// stableNormalized() is inaccurate for denormal numbers.
Eigen::Vector3d unit_vector(const Eigen::Vector3d& v) {
  const bool small = v.cwiseAbs().maxCoeff() < kSmallExtent;
  return small ? Eigen::Vector3d(v * kLift).stableNormalized() : v.stableNormalized();
}

double product_of(double a, double b, double c) {
  const double first = std::abs(a * b);
  if (first > kSmallExtent && first < 1 / kSmallExtent) return a * b * c;
  std::array factors{a, b, c};
  std::sort(factors.begin(), factors.end(), [](double x, double y) { return std::abs(x) < std::abs(y); });
  // The product of the outer two is between the smallest and the largest of the three pairs.
  return factors[0] * factors[2] * factors[1];
}

double norm_up(const Eigen::Vector3d& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  if (largest == 0) return 0;
  if (largest < kSmallExtent) return multiply_up(norm_up(v * kLift), 1 / kLift);
  return sqrt_up(Expansion().add_dot(v, v).up());
}

double distance_up(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Vector3d difference;
  for (int i = 0; i < 3; ++i)
    difference[i] = a[i] > b[i] ? add_up(a[i], -b[i]) : add_up(b[i], -a[i]);
  return norm_up(difference);
}

bool ball_inside_ball(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s) {
  const double slack = r - s;
  const Eigen::Vector3d q = a - b;
  const double d2 = dot3(q, q);
  // The relative errors of d2 and slack^2 are at most 5 * 2^-53 and 3 * 2^-53. The bound of 2^-48 = 32 *
  // 2^-53 exceeds their sum.
  constexpr double error_bound = 0x1p-48;
  const double limit = slack * slack;
  if (limit > kSmallExtent * kSmallExtent) {
    if (d2 < limit * (1 - error_bound)) return true;
    if (d2 > limit * (1 + error_bound)) return false;
  } else if (q.cwiseAbs().maxCoeff() < kSmallExtent && r > 0 && r < kSmallExtent) {
    return ball_inside_ball(a * kLift, b * kLift, r * kLift, s * kLift);
  }
  Expansion excess;
  for (int i = 0; i < 3; ++i)
    add_square_of_difference(excess, a[i], b[i], 1);
  add_square_of_difference(excess, r, s, -1);
  return excess.sign() <= 0 && excess.is_lossless();
}

Aabb box_around(const Eigen::Vector3d& center, const Eigen::Vector3d& half) {
  const auto upper = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
    return at.binaryExpr(half, [](double c, double h) { return add_up(c, h); });
  };
  return {-upper(-center), upper(center)};
}

double orthonormality_error(const Eigen::Matrix3d& axes) {
  if (!axes.allFinite()) return kNan;
  double worst = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j)
      worst = std::max(worst, std::abs(dot3(axes.col(i), axes.col(j)) - (i == j)));
  }
  return worst;
}

double matrix_norm_up(const Eigen::Matrix3d& m) {
  double result = 0;
  for (int i = 0; i < 3; ++i) {
    double row = 0;
    for (int j = 0; j < 3; ++j)
      row = add_up(row, Expansion().add_dot(m.col(i), m.col(j)).magnitude_up());
    result = std::max(result, row);
  }
  return sqrt_up(result);
}

PointWithError transform_point(const Eigen::Isometry3d& transform, const Eigen::Vector3d& p) {
  const Eigen::Vector3d moved = transform * p;
  Eigen::Vector3d error;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d row = transform.linear().row(i);
    error[i] = Expansion().add(transform(i, 3)).add(-moved[i]).add_dot(row, p).magnitude_up();
  }
  return {moved, norm_up(error)};
}

double difference_up(const Eigen::Matrix3d& m, const Eigen::Vector3d& v, double factor,
                     const Eigen::Vector3d& w) {
  Eigen::Vector3d error;
  for (int i = 0; i < 3; ++i)
    error[i] = Expansion().add_product(-factor, w[i]).add_dot(m.row(i), v).magnitude_up();
  return norm_up(error);
}

}  // namespace pcl_bv::detail
