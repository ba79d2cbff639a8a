// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far a body reaches that half-spaces enclose: linear programs in three variables whose answers are
// proven.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "pcl_bv/volumes/hull.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv {

/// All p with normal . p <= offset for each plane, by exact arithmetic or as Hull::contains() and
/// Kdop::contains() compute it.
class PlaneBody {
 public:
  explicit PlaneBody(const Kdop& kdop);
  explicit PlaneBody(const Hull& hull);

  /// An upper bound of direction . p; tight to some units in the last place of the coordinates and 2^-48 of
  /// the weights with which the planes prove it. Infinity where they prove none: not every body of planes is
  /// bounded. O(planes), some ten times.
  double reach_up(const Eigen::Vector3d& direction) const;

  /// A box around all p; none if that cannot be proven.
  std::optional<Aabb> box() const;

 private:
  struct Proof {
    double bound;  // of direction . p, but for
    double doubt;  // times the greatest |coordinate| of p
  };
  struct Corner {
    std::array<std::size_t, 3> sides;
    Eigen::Vector3d weights;  // of the sides' normals: they sum up to the direction
  };

  bool set_out(const Aabb& about);
  void add(const Eigen::Vector3d& normal, double offset);
  Corner farthest(const Eigen::Vector3d& direction) const;
  std::optional<std::size_t> most_violated(const Eigen::Vector3d& point) const;
  Proof prove(const Eigen::Vector3d& direction) const;
  void prove_box();

  // The first six are sides of a box that should hold the body and that no bound may rest on.
  std::vector<HullPlane> planes_;
  std::vector<double> local_;  // offsets as seen from origin_
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::optional<Aabb> box_;
};

}  // namespace pcl_bv
