// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Exact sums of products, rounded up.
#include "motion.h"

#include <algorithm>

#include "directed.h"

namespace pcl_bv::volumes_internal {

double stretch_up(const Eigen::Matrix3d& m) {
  double result = 0;
  for (int i = 0; i < 3; ++i) {
    double row = 0;
    for (int j = 0; j < 3; ++j) {
      ExactSum dot;
      for (int k = 0; k < 3; ++k)
        dot.add_product(m(k, i), m(k, j));
      row = add_up(row, std::max(dot.up(), -dot.down()));
    }
    result = std::max(result, row);
  }
  return sqrt_up(result);
}

MovedPoint move_point(const Eigen::Isometry3d& transform, const Eigen::Vector3d& p) {
  const Eigen::Vector3d moved = transform * p;
  Eigen::Vector3d error;
  for (int i = 0; i < 3; ++i) {
    ExactSum sum;
    sum.add(transform(i, 3)).add(-moved[i]);
    for (int j = 0; j < 3; ++j)
      sum.add_product(transform(i, j), p[j]);
    error[i] = std::max(sum.up(), -sum.down());
  }
  return {moved, norm_up(error)};
}

double difference_up(const Eigen::Matrix3d& m, const Eigen::Vector3d& v, double factor,
                     const Eigen::Vector3d& w) {
  Eigen::Vector3d error;
  for (int i = 0; i < 3; ++i) {
    ExactSum sum;
    sum.add_product(-factor, w[i]);
    for (int j = 0; j < 3; ++j)
      sum.add_product(m(i, j), v[j]);
    error[i] = std::max(sum.up(), -sum.down());
  }
  return norm_up(error);
}

}  // namespace pcl_bv::volumes_internal
