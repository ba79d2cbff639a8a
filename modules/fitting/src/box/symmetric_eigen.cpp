// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/symmetric_eigen.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "local_frame.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

struct Rotation {
  double tangent, sine, cosine;
};

// Returns the rotation that makes `off_diagonal` zero. Below 2^-30 of the difference, the tangent is the
// angle and the cosine is 1, both to 2^-60, without the two square roots. The last rounds have such angles
// only.
Rotation rotation_of(double first, double second, double off_diagonal) {
  const double twice_off_diagonal = 2 * off_diagonal, difference = second - first;
  if (std::abs(twice_off_diagonal) <= 0x1p-30 * std::abs(difference)) {
    const double angle = off_diagonal / difference;
    return {angle, angle, 1};
  }
  const double length = std::sqrt(difference * difference + twice_off_diagonal * twice_off_diagonal);
  const double tangent = twice_off_diagonal / (difference + std::copysign(length, difference));
  const double cosine = std::sqrt(0.5 + 0.5 * (std::abs(difference) / length));
  return {tangent, tangent * cosine, cosine};
}

// Rotates `v` and the upper triangle of `a` so that a(p, q) becomes zero. The largest entry is about 1, so an
// entry below 2^-500 changes nothing, and its square could underflow to 0.
template <int p, int q>
void rotate(Eigen::Matrix3d& a, Eigen::Matrix3d& v) {
  if (std::abs(a(p, q)) < 0x1p-500) {
    a(p, q) = 0;
    return;
  }
  constexpr int r = 3 - p - q;
  const auto [t, s, c] = rotation_of(a(p, p), a(q, q), a(p, q));
  const auto rotate_pair = [sine = s, cosine = c](double& x, double& y) {
    const double old = x;
    x = cosine * old - sine * y;
    y = sine * old + cosine * y;
  };
  a(p, p) -= t * a(p, q);
  a(q, q) += t * a(p, q);
  a(p, q) = 0;
  rotate_pair(a(std::min(p, r), std::max(p, r)), a(std::min(q, r), std::max(q, r)));
  for (int k = 0; k < 3; ++k)
    rotate_pair(v(k, p), v(k, q));
}

}  // namespace

SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix) {
  const double scale = unit_scale(matrix.cwiseAbs().maxCoeff());  // no square overflows
  Eigen::Matrix3d a = scale * matrix, v = Eigen::Matrix3d::Identity();
  for (int sweep = 0; sweep < 20; ++sweep) {
    const double off = (std::abs(a(0, 1)) + std::abs(a(0, 2))) + std::abs(a(1, 2));
    const double on = (std::abs(a(0, 0)) + std::abs(a(1, 1))) + std::abs(a(2, 2));
    if (!(off > 0x1p-70 * on)) break;
    rotate<0, 1>(a, v);
    rotate<0, 2>(a, v);
    rotate<1, 2>(a, v);
  }
  int order[3] = {0, 1, 2};
  const auto greater_first = [&](int& i, int& j) {
    if (a(i, i) < a(j, j)) std::swap(i, j);
  };
  greater_first(order[0], order[1]);
  greater_first(order[1], order[2]);
  greater_first(order[0], order[1]);
  SymmetricEigen result;
  for (int k = 0; k < 3; ++k) {
    result.values[k] = a(order[k], order[k]) / scale;
    result.vectors.col(k) = v.col(order[k]);
  }
  result.vectors.col(0) = unit3(result.vectors.col(0));
  const Eigen::Vector3d first = result.vectors.col(0), second = result.vectors.col(1);
  result.vectors.col(1) = unit3(second - dot3(first, second) * first);
  result.vectors.col(2) = cross3(first, result.vectors.col(1));
  return result;
}

}  // namespace pcl_bv::detail
