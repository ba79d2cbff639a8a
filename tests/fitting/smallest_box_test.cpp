// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims that obb-min finds the smallest box of up to 128 hull vertices. Any box around the points is an
// upper bound of the smallest, so whatever the references below find must not be smaller than the fit.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "executions.h"
#include "fits.h"
#include "numbers.h"
#include "obbs.h"
#include "pcl_bv/fitting/fit.h"

namespace pcl_bv::detail {
namespace {

using namespace test;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;
using Long = Eigen::Matrix<long double, 3, 1>;

constexpr double kAbove = 1 + 1e-9;

// Of the default set; the box of every other has the same bits.
EstimationResult fit_smallest(const Points& points, Obb& box) {
  const PointView view = PointView::of(points.front().data(), sizeof(Vector3d), points.size());
  const EstimationResult result = take(fit_obb(view, ObbMethod::minimal), box);
  for (const Isa isa : usable_isas()) {
    const Obb other = *fit_obb(view, ObbMethod::minimal, {Serial{}, isa});
    EXPECT_EQ(bits(AnyVolume(other)), bits(AnyVolume(box))) << isa_name(isa);
  }
  return result;
}

double least_volume(const Points& points) {
  Obb box;
  fit_smallest(points, box);
  return box.volume();
}

// O'Rourke's boxes by definition: n1 is normal to one difference of points and n2 to another and to n1. All
// pairs of points, not only edges, and all turns.
class AllPairs {
 public:
  explicit AllPairs(const Points& points) {
    for (const Vector3d& p : points)
      points_.push_back(p.cast<long double>());
  }

  double least_volume() const {
    long double least = std::numeric_limits<long double>::infinity();
    std::vector<Long> differences;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      for (std::size_t k = i + 1; k < points_.size(); ++k)
        if (points_[i] != points_[k]) differences.push_back(points_[i] - points_[k]);
    }
    for (const Long& one : differences) {
      for (const Long& other : differences)
        least = std::min(least, least_of_pair(one, other, least));
    }
    return static_cast<double>(least);
  }

 private:
  static constexpr int kSteps = 48;

  long double volume(const Long& one, const Long& other, long double angle) const {
    const Long u = one.unitOrthogonal(), v = one.cross(u).normalized();
    const Long n1 = std::cos(angle) * u + std::sin(angle) * v;
    const Long n2 = other.cross(n1);
    if (n2.squaredNorm() < 1e-12L * other.squaredNorm()) return std::numeric_limits<long double>::infinity();
    const Long axes[3] = {n1, n2.normalized(), n1.cross(n2).normalized()};
    long double product = 1;
    for (const Long& axis : axes) {
      long double low = axis.dot(points_.front()), high = low;
      for (const Long& p : points_) {
        low = std::min(low, axis.dot(p));
        high = std::max(high, axis.dot(p));
      }
      product *= high - low;
    }
    return product;
  }

  // Samples of half a turn; those that may hide less than the least so far are searched by thirds.
  long double least_of_pair(const Long& one, const Long& other, long double least) const {
    const long double step = std::acos(-1.0L) / kSteps;
    std::array<long double, kSteps> samples;
    for (int i = 0; i < kSteps; ++i)
      samples[static_cast<std::size_t>(i)] = volume(one, other, i * step);
    for (int i = 0; i < kSteps; ++i) {
      const auto at = [&](int k) { return samples[static_cast<std::size_t>((k + kSteps) % kSteps)]; };
      if (at(i) > at(i - 1) || at(i) > at(i + 1) || at(i) > 1.3L * least) continue;
      long double low = (i - 1) * step, high = (i + 1) * step;
      for (int round = 0; round < 70; ++round) {
        const long double third = (high - low) / 3;
        const bool left = volume(one, other, low + third) < volume(one, other, high - third);
        (left ? high : low) += left ? -third : third;
      }
      least = std::min(least, volume(one, other, (low + high) / 2));
    }
    return least;
  }

  std::vector<Long> points_;
};

// The smallest rectangle with a side along the line between two of the points seen along an axis, for each
// axis in turn, from random rotations.
double least_of_descents(const Points& points, int starts, std::mt19937_64& random) {
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < starts; ++start) {
    Matrix3d axes = random_turn(random);
    int stuck_axes = 0;
    for (int axis = 0; stuck_axes < 3; axis = (axis + 1) % 3) {
      std::vector<Eigen::Vector2d> seen;
      const Vector3d u = axes.col((axis + 1) % 3), v = axes.col((axis + 2) % 3);
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Vector3d& p : points) {
        seen.emplace_back(p.dot(u), p.dot(v));
        low = std::min(low, p.dot(axes.col(axis)));
        high = std::max(high, p.dot(axes.col(axis)));
      }
      // Andrew's monotone chain.
      std::sort(seen.begin(), seen.end(),
                [](const auto& a, const auto& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
      std::vector<Eigen::Vector2d> chain;
      for (int side = 0; side < 2; ++side, std::reverse(seen.begin(), seen.end())) {
        const std::size_t base = chain.size();
        for (const Eigen::Vector2d& p : seen) {
          while (chain.size() >= base + 2) {
            const Eigen::Vector2d a = chain.back() - chain[chain.size() - 2], b = p - chain.back();
            if (a.x() * b.y() - a.y() * b.x() > 0) break;
            chain.pop_back();
          }
          chain.push_back(p);
        }
        chain.pop_back();
      }
      double area = std::numeric_limits<double>::infinity();
      Eigen::Vector2d best = Eigen::Vector2d::UnitX();
      for (std::size_t i = 0; i < chain.size(); ++i) {
        const Eigen::Vector2d side = (chain[(i + 1) % chain.size()] - chain[i]).normalized(),
                              across(-side.y(), side.x());
        double left = 0, right = 0, top = 0;
        for (const Eigen::Vector2d& p : chain) {
          left = std::min(left, side.dot(p - chain[i]));
          right = std::max(right, side.dot(p - chain[i]));
          top = std::max(top, across.dot(p - chain[i]));
        }
        if ((right - left) * top < area) area = (right - left) * top, best = side;
      }
      const double volume = area * (high - low);
      stuck_axes = volume < least * (1 - 1e-12) ? 0 : stuck_axes + 1;
      if (volume < least) least = volume;
      axes.col((axis + 1) % 3) = best.x() * u + best.y() * v;
      axes.col((axis + 2) % 3) = best.x() * v - best.y() * u;
    }
  }
  return least;
}

// Clouds of several kinds: gaussian, on a sphere, in a box, on a lattice, near edges of a box, a needle, a
// slab.
Points random_points(std::size_t count, int kind, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(-1, 1);
  const Matrix3d turn = random_turn(random);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    Vector3d p(normal(random), normal(random), normal(random));
    if (kind == 1) p.normalize();
    if (kind == 2) p = {unit(random), unit(random), unit(random)};
    if (kind == 3)
      p = {std::floor(3 * unit(random)), std::floor(3 * unit(random)), std::floor(2 * unit(random))};
    if (kind == 4) p = Vector3d(p[0] > 0 ? 2 : -2, p[1] > 0 ? 1 : -1, unit(random)) + 0.05 * p;
    if (kind == 5) p = {30 * p[0], p[1], p[2]};
    if (kind == 6) p = {p[0], p[1], 1e-3 * p[2]};
    points.emplace_back(turn * p);
  }
  return points;
}

// Volumes of flat ones, of the lattice, are rounding alone.
Points random_solid(std::size_t count, int kind, std::mt19937_64& random) {
  for (;;) {
    Points points = random_points(count, kind, random);
    Obb box;
    if (fit_smallest(points, box).rank == 3) return points;
  }
}

TEST(SmallestBox, OfSixPointsIsFoundWhereASearchFromManyFramesEndsSevenPercentAboveIt) {
  const Points points = {{-0.67746565, -1.64365277, -0.64916032}, {-2.14217331, -2.48597609, -0.24273648},
                         {1.22471828, -1.08172166, -0.09338548},  {-1.54952214, -1.1875085, 0.05844015},
                         {1.21571983, -1.27322655, -0.00545307},  {0.77429938, 0.35840645, -0.44205174}};
  EXPECT_LE(least_volume(points), AllPairs(points).least_volume() * kAbove);
  EXPECT_NEAR(least_volume(points), 3.8073, 5e-5);
}

TEST(SmallestBox, OfPointsOfWhichTwoAreTooNearToSquareTheirDistanceIsThatWithoutOneOfThem) {
  const Points apart = {{0, 0, 0}, {2, 0, 0}, {0, -1, 0}, {0, 0, 10}};
  for (const double tiny : {-1e-150, -1e-162, -1e-200, 1e-300, -std::numeric_limits<double>::denorm_min()}) {
    for (int axis = 0; axis < 3; ++axis) {
      Points points = apart;
      points.push_back(apart[1] + tiny * Vector3d::Unit(axis));
      EXPECT_NEAR(least_volume(points), least_volume(apart), 1e-12) << tiny << " along axis " << axis;
    }
  }
}

TEST(SmallestBox, IsNotAboveThatOnAnyTwoPairsOfPoints) {
  std::mt19937_64 random(21);
  for (int i = 0; i < (test::kFewCases ? 35 : 140); ++i) {
    const Points points = random_solid(4 + static_cast<std::size_t>(i) % 5, i % 7, random);
    EXPECT_LE(least_volume(points), AllPairs(points).least_volume() * kAbove) << "seed 21, " << i;
  }
}

TEST(SmallestBox, IsNotAboveThatOfAnyDescentAroundTenThousandSetsOfFourToHundredPoints) {
  std::mt19937_64 random(22);
  const int sets = test::kFewCases ? 500 : 10'000;
  int missed = 0;
  for (int i = 0; i < sets; ++i) {
    const Points points = random_solid(4 + random() % 97, i % 7, random);
    const double fitted = least_volume(points), found = least_of_descents(points, 3, random);
    EXPECT_LE(fitted, found * kAbove) << "seed 22, " << i;
    missed += found > fitted * kAbove;
  }
  EXPECT_GT(missed, sets / 10) << "the sets are too easy";
}

}  // namespace
}  // namespace pcl_bv::detail
