// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Gaertner, "Fast and robust smallest enclosing balls", ESA 1999, written from its description.

#include "pcl_bv/fitting/small_ball.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>

namespace pcl_bv {
namespace {

// One stated order and no fused operations, where Eigen's reductions may differ between architectures.
double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return dot(a - b, a - b);
}

// The smallest ball with up to four given points on its boundary, built one point at a time.
class SupportBall {
 public:
  int size() const { return size_; }
  const SmallBall& ball() const { return balls_[static_cast<std::size_t>(size_)]; }

  double excess(const Eigen::Vector3d& p) const {
    return squared_distance(p, ball().center) - ball().squared_radius;
  }

  // Makes p a boundary point. False, and nothing changes, if p lies in the affine hull of those that are
  // there.
  bool push(const Eigen::Vector3d& p) {
    const auto m = static_cast<std::size_t>(size_);
    if (m == 0) {
      origin_ = p;
      balls_[1] = {p, 0.0};
    } else {
      Eigen::Vector3d normal = p - origin_;  // becomes the part of p orthogonal to the affine hull
      for (std::size_t i = 1; i < m; ++i)
        normal -= 2.0 / z_[i] * dot(normals_[i], p - origin_) * normals_[i];
      const double z = 2.0 * dot(normal, normal);
      // Relative to the ball, since coordinates have any unit: closer to the hull than 1e-13 radii is on it.
      if (!(z > 1e-26 * balls_[m].squared_radius)) return false;
      const double e = excess(p);
      normals_[m] = normal;
      z_[m] = z;
      balls_[m + 1] = {balls_[m].center + e / z * normal, balls_[m].squared_radius + e * (e / z) / 2.0};
    }
    ++size_;
    return true;
  }

  void pop() { --size_; }

 private:
  int size_ = 0;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::array<SmallBall, 5> balls_;
  std::array<Eigen::Vector3d, 4> normals_ = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                             Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<double, 4> z_{};
};

class Solver {
 public:
  explicit Solver(std::vector<Eigen::Vector3d>& points) : points_(points) {}

  SmallBall solve() {
    if (points_.empty()) return {};
    std::size_t looked_at = 1;
    move_to_front_ball(looked_at);
    for (;;) {
      const std::size_t pivot = farthest(looked_at);
      if (pivot == points_.size()) return best_;
      // The support of the best ball and the pivot decide the next one.
      SmallBall before = best_;
      const std::size_t old_support = support_;
      support_ball_.push(points_[pivot]);
      move_to_front_ball(old_support);
      support_ball_.pop();
      move_to_front(pivot);
      looked_at = old_support + 1;
      // Rounding can make the radius stand still; without this it could circle for ever.
      if (!(best_.squared_radius > before.squared_radius)) return before;
    }
  }

 private:
  // The smallest ball of the first `end` points with those of the support ball on its boundary, into best_.
  void move_to_front_ball(std::size_t end) {
    support_ = 0;
    best_ = support_ball_.ball();
    if (support_ball_.size() == 4) return;
    for (std::size_t k = 0; k < end; ++k) {
      if (!(excess(points_[k]) > 0.0) || !support_ball_.push(points_[k])) continue;
      move_to_front_ball(k);
      support_ball_.pop();
      move_to_front(k);
    }
  }

  double excess(const Eigen::Vector3d& p) const {
    return squared_distance(p, best_.center) - best_.squared_radius;
  }

  std::size_t farthest(std::size_t begin) const {
    std::size_t pivot = points_.size();
    double greatest = 0.0;
    for (std::size_t k = begin; k < points_.size(); ++k) {
      const double e = excess(points_[k]);
      if (e > greatest) {
        greatest = e;
        pivot = k;
      }
    }
    return pivot;
  }

  void move_to_front(std::size_t k) {
    std::rotate(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(k),
                points_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    if (k >= support_) ++support_;
  }

  std::vector<Eigen::Vector3d>& points_;
  SupportBall support_ball_;
  SmallBall best_;
  std::size_t support_ = 0;  // how many of the first points support best_
};

}  // namespace

SmallBall smallest_ball(std::vector<Eigen::Vector3d>& points) {
  return Solver(points).solve();
}

}  // namespace pcl_bv
