// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "prism/widest_angle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/volumes/planar_hull.h"

namespace pcl_bv::detail {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Compares angles by their cotangents, so that the result needs no function that libraries round differently.
// Points at which the edge subtends at least the angle of the best point so far are in the circle through a,
// b and this point.
class AngleSearch {
 public:
  AngleSearch(const PlanarGrid& grid, const std::vector<char>& is_corner, const Eigen::Vector2d& a,
              const Eigen::Vector2d& b)
      : grid_(grid), is_corner_(is_corner), a_(a), b_(b), edge_(b - a), normal_(-edge_.y(), edge_.x()) {}

  std::optional<std::uint32_t> find() {
    // A long edge often subtends the largest angle near its ends. Points there make the circle small at once.
    const Eigen::Vector2d& size = grid_.cell_size();
    search(a_ - size, a_ + size);
    search(b_ - size, b_ + size);
    const auto [low, high] = remaining_box();
    search(low, high);
    return best_;
  }

 private:
  void search(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    grid_.visit_cells(low, high,
                      [&](std::uint32_t begin, std::uint32_t end, const Eigen::Vector2d& corner,
                          const Eigen::Vector2d& opposite) {
                        if (is_excluded(corner, opposite)) return false;
                        for (std::uint32_t i = begin; i < end; ++i)
                          consider(i);
                        return false;
                      });
  }

  // Returns whether a cell is to the right of the edge or outside of the circle.
  bool is_excluded(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const {
    const Eigen::Vector2d leftmost(normal_.x() > 0 ? high.x() : low.x(),
                                   normal_.y() > 0 ? high.y() : low.y());
    if (cross(edge_, leftmost - a_) < 0) return true;
    if (!best_) return false;
    const Eigen::Vector2d nearest = center_.cwiseMax(low).cwiseMin(high);
    return (nearest - center_).squaredNorm() > squared_radius_ * (1 + 0x1p-40);
  }

  void consider(std::uint32_t i) {
    const Eigen::Vector2d& p = grid_.points()[i];
    const Eigen::Vector2d from = p - a_, to = p - b_;
    const double height = cross(edge_, from), along = from.x() * to.x() + from.y() * to.y();
    const double rounding = height_rounding(from);
    if (height < -rounding || (height > rounding && along > height * cotangent_)) return;
    if (is_corner_[i] != 0) return;
    const std::optional<double> cotangent = cotangent_of(p, height, along, rounding);
    if (!cotangent || *cotangent > cotangent_) return;
    if (*cotangent == cotangent_ && best_ && !comes_before(p, grid_.points()[*best_])) return;
    set_best(i, *cotangent);
  }

  double height_rounding(const Eigen::Vector2d& from) const {
    return 0x1p-48 * (std::abs(edge_.x() * from.y()) + std::abs(edge_.y() * from.x())) + kSmallestNormal;
  }

  // Returns nothing for a point to the right of the edge, or on its line but not between its ends.
  std::optional<double> cotangent_of(const Eigen::Vector2d& p, double height, double along,
                                     double rounding) const {
    if (std::abs(height) > rounding) {
      if (height < 0) return std::nullopt;
      return along / height;
    }
    const int side = orientation(a_, b_, p);
    if (side < 0 || (side == 0 && !(along < 0))) return std::nullopt;
    if (side == 0) return -kInfinity;
    return along < 0 ? -std::numeric_limits<double>::max() : std::numeric_limits<double>::max();
  }

  static bool comes_before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  }

  void set_best(std::uint32_t i, double cotangent) {
    best_ = i;
    cotangent_ = cotangent;
    center_ = 0.5 * (a_ + b_) + (0.5 * cotangent) * normal_;
    squared_radius_ = 0.25 * edge_.squaredNorm() * (1 + cotangent * cotangent);
  }

  struct Box {
    Eigen::Vector2d low, high;
  };

  // Returns a box around the part of the circle to the left of the edge.
  Box remaining_box() const {
    const Eigen::Vector2d low = a_.cwiseMin(b_), high = a_.cwiseMax(b_);
    if (!best_ || cotangent_ > 0) {
      const double radius = std::sqrt(squared_radius_);
      const Eigen::Vector2d everywhere = Eigen::Vector2d::Constant(kInfinity);
      if (!best_ || !(radius < 1e150)) return {-everywhere, everywhere};
      return {(center_.array() - radius).matrix().cwiseMin(low),
              (center_.array() + radius).matrix().cwiseMax(high)};
    }
    // sqrt(1 + c^2) + c without cancellation, for the height of the arc above the edge.
    const double height = 0.5 / (std::sqrt(1 + cotangent_ * cotangent_) - cotangent_);
    const Eigen::Vector2d up = height * normal_;
    return {low.cwiseMin(low + up), high.cwiseMax(high + up)};
  }

  const PlanarGrid& grid_;
  const std::vector<char>& is_corner_;
  Eigen::Vector2d a_, b_, edge_, normal_;
  std::optional<std::uint32_t> best_;
  double cotangent_ = kInfinity, squared_radius_ = kInfinity;
  Eigen::Vector2d center_ = Eigen::Vector2d::Zero();
};

}  // namespace

std::optional<std::uint32_t> widest_angle(const PlanarGrid& grid, const std::vector<char>& is_corner,
                                          const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return AngleSearch(grid, is_corner, a, b).find();
}

}  // namespace pcl_bv::detail
