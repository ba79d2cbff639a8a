// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/small_ball.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

using Vector = Eigen::Vector3d;

// Squared distances that differ by smaller factors than these are treated as equal. kRounding is for
// distances from one centre. kTie is for distances from two computed centres of the same ball.
constexpr double kRounding = 1 + 0x1p-50;
constexpr double kTie = 1 + 0x1p-46;

double squared_distance(const Vector& a, const Vector& b) {
  return dot3(a - b, a - b);
}

// Solves rows[i] . x = right[i] by elimination with row pivoting. The residual is small even if the rows are
// nearly dependent. This matters because the residual decides how far the points of a support are outside
// their ball. Returns false if the rows are dependent.
bool solve(std::array<Vector, 3> rows, Vector right, Vector& x) {
  for (int column = 0; column < 3; ++column) {
    int pivot = column;
    for (int row = column + 1; row < 3; ++row) {
      if (std::abs(rows[row][column]) > std::abs(rows[pivot][column])) pivot = row;
    }
    if (rows[pivot][column] == 0) return false;
    std::swap(rows[pivot], rows[column]);
    std::swap(right[pivot], right[column]);
    for (int row = column + 1; row < 3; ++row) {
      const double factor = rows[row][column] / rows[column][column];
      for (int k = column + 1; k < 3; ++k)
        rows[row][k] -= factor * rows[column][k];
      right[row] -= factor * right[column];
    }
  }
  x.z() = right.z() / rows[2].z();
  x.y() = (right.y() - rows[1].z() * x.z()) / rows[1].y();
  x.x() = ((right.x() - rows[0].y() * x.y()) - rows[0].z() * x.z()) / rows[0].x();
  return true;
}

// Returns the weights w with sum w_i spokes[i] = x; NaN if the spokes are linearly dependent.
Vector weights(const std::array<Vector, 3>& spokes, const Vector& x) {
  std::array<Vector, 3> rows;
  for (int axis = 0; axis < 3; ++axis)
    rows[axis] = {spokes[0][axis], spokes[1][axis], spokes[2][axis]};
  Vector result;
  return solve(rows, x, result) ? result : Vector::Constant(kNan);
}

// Finds the best ball of a support of up to four points and one new point. The new point must be on the
// boundary of the ball. All coordinates are relative to the new point.
class Step {
 public:
  Step(const Vector* points, const std::array<std::size_t, 4>& support, int size, std::size_t pivot)
      : size_(size) {
    for (int i = 0; i < size; ++i) {
      spokes_[i] = points[support[i]] - points[pivot];
      squared_[i] = dot3(spokes_[i], spokes_[i]);
    }
  }

  // Returns the members of the support that remain: bit i stands for support[i]. Sets the centre, relative to
  // the new point.
  unsigned solve(Vector& center) {
    // Smaller supports are tried first. If the ball of a support contains all points, this ball is the
    // smallest, and larger supports need not be tried.
    if (!try_pairs() && !try_triples()) try_quadruples();
    center = center_;
    return members_;
  }

 private:
  // Compares the ball that has this centre and passes through the new point (the origin) with the best ball
  // so far. Returns whether no point is outside the ball. Several supports of cospherical points have the
  // same ball. Of these supports the one with the largest minimum weight is taken, because the ball is the
  // smallest ball of a support only if no weight is negative.
  template <typename LeastWeight>
  bool offer(unsigned members, const Vector& center, LeastWeight&& least_weight) {
    const double squared_radius = dot3(center, center);
    double greatest = squared_radius;
    for (int i = 0; i < size_; ++i)
      greatest = std::max(greatest, squared_distance(spokes_[i], center));
    if (!(greatest <= greatest_ * kTie)) return false;
    const double weight = least_weight();
    if (greatest * kTie < greatest_ || weight > least_weight_) {
      greatest_ = greatest;
      least_weight_ = weight;
      members_ = members;
      center_ = center;
    }
    return greatest <= squared_radius * kRounding;
  }

  bool try_pairs() {
    for (int i = 0; i < size_; ++i) {
      if (offer(1U << i, spokes_[i] / 2, [] { return 0.5; })) return true;
    }
    return false;
  }

  bool try_triples() {
    for (int i = 0; i < size_; ++i) {
      for (int j = i + 1; j < size_; ++j) {
        const double product = dot3(spokes_[i], spokes_[j]);
        // If the triangle is not acute, its ball is the ball of its longest side, which needs no triple.
        if (product <= 0 || product >= squared_[i] || product >= squared_[j]) continue;
        Vector center;
        const std::array<Vector, 3> rows = {spokes_[i], spokes_[j], cross3(spokes_[i], spokes_[j])};
        if (!detail::solve(rows, {squared_[i] / 2, squared_[j] / 2, 0}, center)) continue;
        if (offer(1U << i | 1U << j, center, [] { return 0.0; })) return true;
      }
    }
    return false;
  }

  // Tries all quadruples until a ball contains all points and has no negative weight. The weights must be
  // checked, because a sphere through four points can contain the fifth point and still not be the smallest.
  void try_quadruples() {
    for (int i = 0; i < size_; ++i) {
      for (int j = i + 1; j < size_; ++j) {
        for (int k = j + 1; k < size_; ++k) {
          Vector center;
          if (detail::solve({spokes_[i], spokes_[j], spokes_[k]},
                            {squared_[i] / 2, squared_[j] / 2, squared_[k] / 2}, center)) {
            const bool holds_all = offer(1U << i | 1U << j | 1U << k, center, [&] {
              const Vector rest = weights({spokes_[i], spokes_[j], spokes_[k]}, center);
              return std::min(rest.minCoeff(), 1 - ((rest.x() + rest.y()) + rest.z()));
            });
            if (holds_all && least_weight_ >= 0) return;
          }
        }
      }
    }
  }

  int size_;
  std::array<Vector, 4> spokes_;
  std::array<double, 4> squared_{};
  double greatest_ = kInfinity;
  double least_weight_ = -kInfinity;
  unsigned members_ = 0;
  Vector center_ = Vector::Zero();
};

// Computes the weights with which the centre is the weighted mean of the support points. A negative weight,
// which only rounding can cause, becomes 0.
void weigh(const Vector* points, SmallBall& ball) {
  const Vector origin = points[ball.support[0]];
  std::array<Vector, 3> spokes = {Vector::Zero(), Vector::Zero(), Vector::Zero()};
  for (int i = 1; i < ball.support_size; ++i)
    spokes[i - 1] = points[ball.support[i]] - origin;
  Vector rest = Vector::Zero();
  if (ball.support_size == 2) rest = {0.5, 0, 0};
  if (ball.support_size == 3) spokes[2] = cross3(spokes[0], spokes[1]);
  if (ball.support_size > 2) rest = weights(spokes, ball.center - origin);
  double sum = 0;
  for (int i = 1; i < ball.support_size; ++i)
    sum += ball.weights[i] = std::max(0.0, rest[i - 1]);
  ball.weights[0] = std::max(0.0, 1 - sum);
  sum += ball.weights[0];
  for (double& weight : ball.weights)
    weight /= sum;
}

// Returns sum w_i |q_i|^2 - |sum w_i q_i|^2, with the support points q_i relative to the centre. For any
// weights, no ball around the support points has a smaller squared radius.
double squared_lower_bound(const Vector* points, const SmallBall& ball) {
  double squares = 0;
  Vector mean = Vector::Zero();
  for (int i = 0; i < ball.support_size; ++i) {
    const Vector q = points[ball.support[i]] - ball.center;
    squares += ball.weights[i] * dot3(q, q);
    mean += ball.weights[i] * q;
  }
  return squares - dot3(mean, mean);
}

std::size_t farthest(const Vector* points, std::size_t count, const Vector& center, double& greatest) {
  std::size_t found = 0;
  greatest = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const double d2 = squared_distance(points[i], center);
    if (d2 > greatest) {
      greatest = d2;
      found = i;
    }
  }
  return found;
}

}  // namespace

SmallBall smallest_ball(const Eigen::Vector3d* points, std::size_t count, const SmallBall* start) {
  SmallBall best;
  if (count == 0) return best;
  double greatest = 0;
  SmallBall ball;
  if (start != nullptr && start->support_size > 0) {
    ball = *start;
  } else {
    ball.support = {farthest(points, count, points[0], greatest)};
    ball.support_size = 1;
    ball.center = points[ball.support[0]];
    ball.squared_radius = 0;
  }
  // The ball of each step is larger than the ball before, until the difference is smaller than rounding
  // errors. Far fewer than 200 steps are needed.
  for (int steps = 0; steps < 200; ++steps) {
    const std::size_t pivot = farthest(points, count, ball.center, greatest);
    const bool done = greatest <= ball.squared_radius * kRounding;
    if (done || best.squared_radius < 0 || greatest < best.squared_radius) {
      best = ball;
      best.squared_radius = greatest;
    }
    if (done) break;
    Vector center;
    const unsigned members = Step(points, ball.support, ball.support_size, pivot).solve(center);
    std::array<std::size_t, 4> support{pivot};
    int size = 1;
    for (int i = 0; i < ball.support_size; ++i) {
      if ((members >> i & 1U) != 0) support[size++] = ball.support[i];
    }
    ball.support = support;
    ball.support_size = size;
    ball.center = points[pivot] + center;
    ball.squared_radius = 0;
    for (int i = 0; i < size; ++i)
      ball.squared_radius = std::max(ball.squared_radius, squared_distance(points[support[i]], ball.center));
  }
  weigh(points, best);
  best.squared_lower_bound = squared_lower_bound(points, best);
  return best;
}

}  // namespace pcl_bv::detail
