// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How many dimensions a few directions span: those in which a cloud does not vary take its rank down.
#pragma once

#include <Eigen/Dense>
#include <cstddef>

#include "pcl_bv/fitting/result.h"

namespace pcl_bv {

/// Grows by one direction at a time; directions that differ by less than a 1e-12th count as parallel.
class Span {
 public:
  void add(const Eigen::Vector3d& direction) {
    const Eigen::Vector3d unit = direction.normalized();
    if (dimensions_ == 0) {
      first_ = unit;
      dimensions_ = 1;
    } else if (dimensions_ == 1 && first_.cross(unit).norm() > 1e-12) {
      normal_ = first_.cross(unit).normalized();
      dimensions_ = 2;
    } else if (dimensions_ == 2 && std::abs(normal_.dot(unit)) > 1e-12) {
      dimensions_ = 3;
    }
  }

  int dimensions() const { return dimensions_; }

 private:
  int dimensions_ = 0;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
};

/// Status and rank as result.h defines them; `flat` spans the directions in which no point differs.
inline EstimationResult result_from(const Span& flat, std::size_t used, std::size_t dropped) {
  if (used == 0) return {EstimationStatus::no_valid_points, 0, used, dropped};
  const int rank = 3 - flat.dimensions();
  return {rank == 3 ? EstimationStatus::ok : EstimationStatus::degenerate, rank, used, dropped};
}

}  // namespace pcl_bv
