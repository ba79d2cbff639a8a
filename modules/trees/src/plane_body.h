// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounds of a body that half-spaces enclose. They are linear programs in three variables with proven results.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "pcl_bv/volumes/hull.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv {

/// All points p with normal . p <= offset for each plane, by exact arithmetic or as computed by
/// Hull::contains() and Kdop::contains().
class PlaneBody {
 public:
  explicit PlaneBody(const Kdop& kdop);
  explicit PlaneBody(const Hull& hull);

  /// Returns an upper bound of direction . p for all points p of the body. Returns infinity if the planes
  /// prove no bound, because a body of planes may be unbounded. The bound is tight to a few units in the last
  /// place of the coordinates and 2^-46 of the weights with which the planes prove it. O(planes), about ten
  /// passes over the planes.
  double support_bound_up(const Eigen::Vector3d& direction) const;

  /// Returns a box around all points of the body. Returns nothing if no box is proven.
  std::optional<Aabb> box() const;

 private:
  // The inequality direction . p <= bound + error_bound |p|, where |p| is the largest absolute coordinate of
  // p.
  struct Proof {
    double bound;
    double error_bound;
  };
  // The intersection of three planes.
  struct PlaneVertex {
    std::array<std::size_t, 3> planes;
    Eigen::Vector3d weights;  // the sum of the normals with these weights is the direction
  };

  bool add_fences(const Aabb& about);
  void add(const Eigen::Vector3d& normal, double offset);
  PlaneVertex optimal_vertex(const Eigen::Vector3d& direction) const;
  std::optional<std::size_t> most_violated(const Eigen::Vector3d& point) const;
  Proof prove(const Eigen::Vector3d& direction) const;
  void prove_box();

  // The first six planes are fences, the sides of a box that should hold the body. No bound may rest on
  // fences.
  std::vector<HullPlane> planes_;
  std::vector<double> local_offsets_;  // offsets relative to origin_
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::optional<Aabb> box_;
};

}  // namespace pcl_bv
