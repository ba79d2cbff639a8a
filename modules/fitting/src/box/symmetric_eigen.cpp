// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/symmetric_eigen.h"

#include <cmath>
#include <utility>

#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

// Applies to `a` and `v` the rotation that makes a(p, q) zero.
void rotate(Eigen::Matrix3d& a, Eigen::Matrix3d& v, int p, int q) {
  if (a(p, q) == 0) return;
  const double theta = (a(q, q) - a(p, p)) / (2 * a(p, q));
  const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const auto rotate_pair = [&](double& x, double& y) {
    const double old = x;
    x = c * old - s * y;
    y = s * old + c * y;
  };
  for (int k = 0; k < 3; ++k)
    rotate_pair(a(k, p), a(k, q));
  for (int k = 0; k < 3; ++k)
    rotate_pair(a(p, k), a(q, k));
  for (int k = 0; k < 3; ++k)
    rotate_pair(v(k, p), v(k, q));
}

}  // namespace

SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix) {
  Eigen::Matrix3d a = matrix, v = Eigen::Matrix3d::Identity();
  for (int sweep = 0; sweep < 20; ++sweep) {
    const double off = (std::abs(a(0, 1)) + std::abs(a(0, 2))) + std::abs(a(1, 2));
    const double on = (std::abs(a(0, 0)) + std::abs(a(1, 1))) + std::abs(a(2, 2));
    if (!(off > 0x1p-70 * on)) break;
    rotate(a, v, 0, 1);
    rotate(a, v, 0, 2);
    rotate(a, v, 1, 2);
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
    result.values[k] = a(order[k], order[k]);
    result.vectors.col(k) = v.col(order[k]);
  }
  result.vectors.col(0) = unit3(result.vectors.col(0));
  const Eigen::Vector3d first = result.vectors.col(0), second = result.vectors.col(1);
  result.vectors.col(1) = unit3(second - dot3(first, second) * first);
  result.vectors.col(2) = cross3(first, result.vectors.col(1));
  return result;
}

}  // namespace pcl_bv::detail
