// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the search for the support of a polytope. Random polytopes are the intersection of a cube and of
// half-spaces that are tangent to the unit sphere.
#include "dual_simplex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "exact.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Vector3d;

// The half-spaces 0 to 5 are the cube with |q_k| <= 2.
struct Tangents {
  Normals normals;
  std::vector<double> offsets;

  Tangents(Random& random, int count) {
    for (int side = 0; side < 6; ++side)
      add((side < 3 ? 1.0 : -1.0) * Vector3d::Unit(side % 3), 2);
    for (int i = 0; i < count; ++i)
      add(random.vector(1).normalized(), 1);
  }

  void add(const Vector3d& normal, double offset) {
    normals.push_back(normal);
    offsets.push_back(offset);
  }
};

void expect_weights(const DualSimplex& simplex, const DualBasis& basis) {
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(basis.weights[k], 0);
    sum += basis.weights[k] * simplex.normals[basis.sides[static_cast<std::size_t>(k)]];
  }
  EXPECT_LE((sum - simplex.direction).norm(), 1e-14);
}

TEST(DualSimplex, WeightsAreNotNegativeAndSumToTheDirection) {
  Random random(81);
  for (int round = 0; round < 200; ++round) {
    const Tangents body(random, round);
    const Vector3d direction = random.vector(1);
    const DualSimplex simplex{body.normals, body.offsets, direction};
    const DualBasis start = simplex.start({0, 1, 2}, 3);
    expect_weights(simplex, start);
    expect_weights(simplex, simplex.solve(start, 1e-13, 0));
  }
}

TEST(DualSimplex, TheCornerIsInAllHalfSpacesAndTheWeightsProveItsProjection) {
  Random random(82);
  for (int round = 0; round < 200; ++round) {
    const Tangents body(random, round);
    const Vector3d direction = random.vector(1);
    const DualSimplex simplex{body.normals, body.offsets, direction};
    const DualBasis basis = simplex.solve(simplex.start({0, 1, 2}, 3), 1e-13, 0);
    double bound = 0;
    for (int k = 0; k < 3; ++k)
      bound += basis.weights[k] * body.offsets[basis.sides[static_cast<std::size_t>(k)]];
    EXPECT_NEAR(direction.dot(basis.corner), bound, 1e-12);
    for (std::size_t i = 0; i < body.offsets.size(); ++i)
      EXPECT_LE(body.normals.projection(i, basis.corner), body.offsets[i] + 1e-12);
  }
}

// Where rounding errors make up most of the determinant, a correction of the weights can make the residual larger.
// The largest residual was 89 when every correction was taken.
TEST(DualSimplex, NearlyParallelNormalsDoNotMakeTheCorrectionOfWeightsWorseThanNone) {
  Random random(84);
  double worst = 0;
  for (int round = 0; round < 4000; ++round) {
    Tangents body(random, 0);
    const Vector3d common = random.vector(1).normalized();
    for (int i = 0; i < 6; ++i) {
      const Vector3d normal = common + 1e-7 * random.vector(1);
      body.add(normal, 1 + 1e-7 * random.vector(1)[0]);
      body.add(-normal, 1);
    }
    const Vector3d direction = common + 0.3e-7 * random.vector(1);
    const DualSimplex simplex{body.normals, body.offsets, direction};
    const DualBasis basis = simplex.solve(simplex.start({0, 1, 2}, 3), 1e-13, 0);
    Vector3d rest = direction;
    for (int k = 0; k < 3; ++k)
      rest -= basis.weights[k] * simplex.normals[basis.sides[static_cast<std::size_t>(k)]];
    worst = std::max(worst, rest.lpNorm<1>());
  }
  EXPECT_LT(worst, 1);
}

TEST(DualSimplex, OnlyCandidatesEnterTheBasis) {
  Random random(83);
  const Tangents body(random, 40);
  const std::vector<std::size_t> candidates{3, 9, 12};
  for (int round = 0; round < 100; ++round) {
    const Vector3d direction = random.vector(1);
    const DualSimplex simplex{body.normals, body.offsets, direction};
    const DualBasis start = simplex.start({0, 1, 2}, 3);
    const DualBasis basis = simplex.solve(start, 1e-13, 0, &candidates);
    for (const std::size_t side : basis.sides)
      EXPECT_TRUE(side < 6 || side == 9 || side == 12) << side;
  }
}

TEST(DualSimplex, ThePowerOfTwoIsThatOfTheLargestComponent) {
  EXPECT_EQ(power_of_two({0.1, -1, 0.9}), 1);
  EXPECT_EQ(power_of_two({0.1, 1, -7.9}), 4);
  EXPECT_EQ(power_of_two({0x1.8p-90, 0, 0}), 0x1p-90);
  EXPECT_EQ(power_of_two({std::numeric_limits<double>::denorm_min(), 0, 0}), 0x1p-1000);
}

// The rounding errors that the search ignores are those of the corner, not of the widest slab.
TEST(DualSimplex, SlabsFarAwayCostNoDigitsOfTightened) {
  SlabVector min(7), max(7);
  min << 0, 0, 0, -1e30, -1e30, -1e30, -1e30;
  max << 1e30, 1e30, 1e30, 1, 1e30, 1e30, 1e30;
  const Kdop tight = Kdop(KdopSet::dop14(), min, max).tightened();
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_LE(tight.max(k), 1 + 1e-13);
}

}  // namespace
}  // namespace pcl_bv::detail
