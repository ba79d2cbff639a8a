// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Shapes of k-DOPs and hulls, which are given by half-spaces. The corners propose support points, and the
// half-spaces prove bounds.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bounds.h"
#include "half_space_body.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"
#include "polytope.h"
#include "shape.h"

namespace pcl_bv::detail {
namespace {

class PolytopeShape : public SupportShape {
 public:
  Eigen::Vector3d support(const Eigen::Vector3d& d) const override {
    std::size_t best = 0;
    double largest = -kInfinity;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double projection = (x_[i] * d[0] + y_[i] * d[1]) + z_[i] * d[2];
      if (projection > largest) {
        largest = projection;
        best = i;
      }
    }
    return {x_[best], y_[best], z_[best]};
  }

  double support_value_up(const Eigen::Vector3d& d) const override {
    return half_spaces_.support_value_up(d, support(d));
  }

  Eigen::Vector3d order_key() const override { return {x_.front(), y_.front(), z_.front()}; }

 protected:
  // `corners` are relative to `from`.
  void set_corners(const Eigen::Vector3d& from, const std::vector<Eigen::Vector3d>& corners) {
    Eigen::Vector3d low = corners.front(), high = corners.front();
    for (const Eigen::Vector3d& v : corners) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    origin = from + (0.5 * low + 0.5 * high);
    const Eigen::Vector3d shift = from - origin;
    for (const Eigen::Vector3d& v : corners) {
      x_.push_back(v[0] + shift[0]);
      y_.push_back(v[1] + shift[1]);
      z_.push_back(v[2] + shift[2]);
    }
    // The body can extend beyond the corners by the rounding errors of coordinates, even if all corners are
    // the same point.
    const Eigen::Vector3d at = origin.cwiseAbs();
    guess_ = 2 * (high - low).maxCoeff() + 0x1p-40 * at.maxCoeff() + kSmallestNormal;
  }

  void add_box() { size = half_spaces_.add_box(guess_) ? half_spaces_.radius_up() : kInfinity; }

  HalfSpaceBody half_spaces_;

 private:
  std::vector<double> x_, y_, z_;
  double guess_ = 0;
};

class HullShape final : public PolytopeShape {
 public:
  explicit HullShape(const Hull& hull) {
    set_corners(hull.vertices().front(), [&] {
      std::vector<Eigen::Vector3d> corners = hull.vertices();
      for (Eigen::Vector3d& v : corners)
        v -= hull.vertices().front();
      return corners;
    }());
    half_spaces_.reserve(hull.planes().size());
    for (const HullPlane& plane : hull.planes())
      half_spaces_.add(plane.normal, plane.offset, origin);
    add_box();
  }
};

class KdopShape final : public PolytopeShape {
 public:
  KdopShape(const Kdop& kdop, const Polytope& polytope) : kdop_(kdop) {
    set_corners(polytope.origin, polytope.vertices);
    half_spaces_.reserve(2 * kdop.size());
    for (std::size_t i = 0; i < kdop.size(); ++i) {
      half_spaces_.add(kdop.set()->direction(i), kdop.max(i), origin);
      half_spaces_.add(-kdop.set()->direction(i), -kdop.min(i), origin);
    }
    add_box();
  }

  Gap parallel_gap(const SupportShape& other) const override {
    const Kdop& b = static_cast<const KdopShape&>(other).kdop_;
    if (*kdop_.set() != *b.set()) return {0, false};
    double best = 0;
    for (std::size_t i = 0; i < kdop_.size(); ++i) {
      double apart = 0;
      if (b.min(i) > kdop_.max(i)) apart = -add_up(kdop_.max(i), -b.min(i));
      if (kdop_.min(i) > b.max(i)) apart = -add_up(b.max(i), -kdop_.min(i));
      if (apart > 0) best = std::max(best, apart / length3(kdop_.set()->direction(i)) * (1 - 0x1p-49));
    }
    return {best, false};
  }

 private:
  Kdop kdop_;
};

}  // namespace

std::shared_ptr<SupportShape> make_polytope(const Hull& hull) {
  return std::make_shared<HullShape>(hull);
}

// Slabs that miss each other only by rounding errors may have a point in common, although intersect_slabs()
// returns no corners. In this case, the corners of the k-DOP's axis-aligned box are used.
std::shared_ptr<SupportShape> make_polytope(const Kdop& kdop) {
  Polytope polytope = intersect_slabs(kdop);
  if (polytope.vertices.empty()) {
    if (kdop.tightened().empty()) return nullptr;
    const Aabb box = kdop.aabb();
    if (box.empty()) return nullptr;
    polytope.vertices.clear();
    for (const Eigen::Vector3d& corner : box.corners())
      polytope.vertices.push_back(corner - polytope.origin);
  }
  return std::make_shared<KdopShape>(kdop, polytope);
}

}  // namespace pcl_bv::detail
