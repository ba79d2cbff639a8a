// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Support values of a body that half-spaces enclose: linear programs in three variables with proven results.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "pcl_bv/volumes/hull.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv {

/// All points with normal . p <= offset for each plane, by exact arithmetic or as Hull::contains() and
/// Kdop::contains() compute it.
class PlaneBody {
 public:
  explicit PlaneBody(const Kdop& kdop);
  explicit PlaneBody(const Hull& hull);

  /// Returns an upper bound of direction . p. Infinity if the planes prove no bound, as a body of planes need
  /// not be bounded. Tight to a few units in the last place of the coordinates and 2^-48 of the weights with
  /// which the planes prove it. O(planes), about ten passes over them.
  double support_bound_up(const Eigen::Vector3d& direction) const;

  /// Returns a box around all points; nothing if no box is proven.
  std::optional<Aabb> box() const;

 private:
  // direction . p <= bound + error_bound |p|, where |p| is the largest absolute coordinate of p
  struct Proof {
    double bound;
    double error_bound;
  };
  // A vertex: the intersection of three planes.
  struct PlaneVertex {
    std::array<std::size_t, 3> planes;
    Eigen::Vector3d weights;  // of the planes' normals; the weighted sum is the direction
  };

  bool add_fences(const Aabb& about);
  void add(const Eigen::Vector3d& normal, double offset);
  PlaneVertex optimal_vertex(const Eigen::Vector3d& direction) const;
  std::optional<std::size_t> most_violated(const Eigen::Vector3d& point) const;
  Proof prove(const Eigen::Vector3d& direction) const;
  void prove_box();

  // The first six are fences: sides of a box that should hold the body. No bound may rest on them.
  std::vector<HullPlane> planes_;
  std::vector<double> local_offsets_;  // offsets relative to origin_
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::optional<Aabb> box_;
};

}  // namespace pcl_bv
