// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion.h"

#include <algorithm>

#include "lengths.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"

namespace pcl_bv::volumes_internal {

double stretch_up(const Eigen::Matrix3d& m) {
  double result = 0;
  for (int i = 0; i < 3; ++i) {
    double row = 0;
    for (int j = 0; j < 3; ++j)
      row = add_up(row, Expansion().add_dot(m.col(i), m.col(j)).magnitude_up());
    result = std::max(result, row);
  }
  return sqrt_up(result);
}

MovedPoint move_point(const Eigen::Isometry3d& transform, const Eigen::Vector3d& p) {
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

}  // namespace pcl_bv::volumes_internal
