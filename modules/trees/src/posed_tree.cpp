// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/point_tree.h"

#include <algorithm>
#include <stdexcept>

#include "box_relation.h"
#include "inflated.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "rotatable.h"

namespace pcl_bv {
using namespace detail;
namespace {

void require_rigid(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d axes = pose.linear();
  const Eigen::Matrix3d deviation = axes.transpose() * axes - Eigen::Matrix3d::Identity();
  if (!pose.matrix().allFinite() || !(deviation.cwiseAbs().maxCoeff() <= 1e-6))
    throw std::invalid_argument("PosedTree: a pose must be finite, its axes unit and orthogonal to 1e-6");
}

// Inverts a near-rotation, with one Newton step from the transpose. The step squares the deviation from a
// rotation. If the axes are orthonormal to 1e-8, the deviation becomes 1e-16, which is only rounding.
Eigen::Isometry3d inverse(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d axes = pose.linear(), transposed = axes.transpose();
  Eigen::Isometry3d back = Eigen::Isometry3d::Identity();
  back.linear() = transposed * (2 * Eigen::Matrix3d::Identity() - axes * transposed);
  back.translation() = -(back.linear() * pose.translation());
  return back;
}

// Returns an upper bound of |back (pose p) - p| for |p|_1 <= max_norm. The first term is for the deviation of
// the product back * pose from the identity. The second term is for rounding.
double round_trip_error(const Eigen::Isometry3d& back, const Eigen::Isometry3d& pose, double max_norm) {
  const Eigen::Matrix3d deviation = back.linear() * pose.linear() - Eigen::Matrix3d::Identity();
  const double translations = taxicab3(pose.translation()) + taxicab3(back.translation());
  return deviation.cwiseAbs().sum() * max_norm + 0x1p-46 * (max_norm + translations);
}

// Returns an upper bound of |p|_1 for the points of the tree, from the topmost boxes of the tree. The bound
// is at least 2^-401 if the tree has points, so errors relative to this bound cover underflow of products,
// too.
double max_taxicab_norm(const BoxLevels& boxes) {
  double max_norm = 0;
  if (boxes.groups.empty()) return max_norm;
  for (std::size_t k = 0; k < kTreeWidth; ++k) {
    const PlainBox box = plain_box(boxes, boxes.groups.back(), k);
    if (box.low.x() <= box.high.x())
      max_norm = std::max(max_norm, box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).sum());
  }
  return max_norm;
}

}  // namespace

PosedTree::PosedTree(const PointTree& tree, const Eigen::Isometry3d& pose) : tree_(tree) {
  const FloatEnvironment environment;
  require_rigid(pose);
  back_ = inverse(pose);
  rounding_ = round_trip_error(back_, pose, max_taxicab_norm(packed_tree(tree).boxes));
}

std::optional<Neighbor> PosedTree::nearest(const Eigen::Vector3d& point, double max_distance) const {
  return tree_.nearest(back_ * point, max_distance);
}

void PosedTree::nearest(const Eigen::Vector3d& point, std::size_t k, std::vector<Neighbor>& found,
                        double max_distance) const {
  tree_.nearest(back_ * point, k, found, max_distance);
}

void PosedTree::near(const Eigen::Vector3d& point, double distance, std::vector<Neighbor>& found) const {
  tree_.near(back_ * point, distance, found);
}

bool PosedTree::any_inside(const AnyVolume& volume) const {
  return tree_.any_inside(moved_back(volume));
}

std::size_t PosedTree::count_inside(const AnyVolume& volume) const {
  return tree_.count_inside(moved_back(volume));
}

void PosedTree::all_inside(const AnyVolume& volume, std::vector<std::int32_t>& indices) const {
  tree_.all_inside(moved_back(volume), indices);
}

std::optional<PointHit> PosedTree::first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                             double radius) const {
  return tree_.first_hit(back_ * origin, back_.linear() * direction, radius);
}

AnyVolume PosedTree::moved_back(const AnyVolume& volume) const {
  const FloatEnvironment environment;
  return inflated(transformed(rotatable(volume), back_), rounding_);
}

}  // namespace pcl_bv
