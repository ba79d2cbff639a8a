// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/numeric/vector3.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "pcl_bv/numeric/coordinates.h"
#include "rational.h"

namespace pcl_bv::detail {
namespace {

using Array = std::array<double, 3>;

constexpr double kHalfStep = 0x1p-53;  // 1 + kHalfStep is 1

TEST(Vector3, AddsFromTheLeft) {
  const Array ones{1, 1, 1}, great_first{1, kHalfStep, kHalfStep}, great_last{kHalfStep, kHalfStep, 1};
  EXPECT_EQ(dot3(ones, great_first), 1);
  EXPECT_EQ(dot3(ones, great_last), 1 + 0x1p-52);
  EXPECT_EQ(taxicab3(Array{-1, kHalfStep, -kHalfStep}), 1);
  EXPECT_EQ(taxicab3(Array{-kHalfStep, kHalfStep, -1}), 1 + 0x1p-52);
}

TEST(Vector3, TakesCoordinatesArraysAndEigensVectorsAndExpressions) {
  const Coordinates p{1, 2, 3};
  const Array a{4, -5, 6};
  const Eigen::Vector3d v(4, -5, 6);
  EXPECT_EQ(dot3(p, a), 12);
  EXPECT_EQ(dot3(2 * v, p), 24);
  EXPECT_EQ(dot3(std::array<std::int8_t, 3>{1, 0, -1}, p), -2) << "a sum of doubles, not of what is narrower";
  EXPECT_EQ(taxicab3(v), 15);
  EXPECT_EQ(norm3(Array{2, -3, 6}), 7);
  EXPECT_EQ(cross3(v, p), Eigen::Vector3d(-27, -6, 13));
  EXPECT_EQ(cross3(a, p), (Array{-27, -6, 13}));
  EXPECT_EQ(unit3(Eigen::Vector3d(2, -3, 6) * 7), Eigen::Vector3d(14 / 49.0, -21 / 49.0, 42 / 49.0));
}

TEST(Vector3, SumsOfRationalsAreExact) {
  using test::Rational;
  const std::array<Rational, 3> a{Rational(1e100), Rational(1), Rational(1e100)};
  const std::array<Rational, 3> b{Rational(1), Rational(3), Rational(-1)};
  EXPECT_EQ(dot3(a, b), Rational(3));
}

}  // namespace
}  // namespace pcl_bv::detail
