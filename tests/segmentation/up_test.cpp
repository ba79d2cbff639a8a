// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/up.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>

#include "up_frame.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

template <typename Function>
std::string refusal(const Function& function) {
  try {
    function();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

Vector3d random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

TEST(Up, IsReadFromSixNamesAndFromThreeNumbers) {
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(parse_up("x"), x);
  EXPECT_EQ(parse_up("y"), y);
  EXPECT_EQ(parse_up("z"), z);
  EXPECT_EQ(parse_up("-x"), -x);
  EXPECT_EQ(parse_up("-y"), -y);
  EXPECT_EQ(parse_up("-z"), -z);
  EXPECT_EQ(parse_up("0.1,-2,3e-5"), Vector3d(0.1, -2, 3e-5));
  EXPECT_EQ(parse_up("0,0,-1e300"), Vector3d(0, 0, -1e300));
}

TEST(Up, IsNothingElse) {
  for (const char* text : {"",     "-",      "Z",     "+z",    "z ",     " z",      "w",       "--z",
                           "xy",   "x,y,z",  "1",     "1,2",   "1,2,",   "1,2,3,",  "1,2,3,4", ",,",
                           "1,,3", "1, 2,3", "1;2;3", "0,0,0", "0,-0,0", "nan,0,1", "0,inf,0", "0,0,1e999"}) {
    const std::string reason = refusal([&] { parse_up(text); });
    EXPECT_THAT(reason, HasSubstr("'" + std::string(text) + "', must be x, y, z, -x, -y, -z or X,Y,Z"));
  }
}

TEST(Up, IsWrittenWithTheFewestDigitsThatReadBackExactly) {
  for (const char* text :
       {"x", "y", "z", "-x", "-y", "-z", "0,0,2", "0.1,-2,0.001", "1,1,0", "5e-324,0,1e+300"})
    EXPECT_EQ(format_up(parse_up(text)), text);
  EXPECT_EQ(format_up({-0.0, -0.0, -1}), "-z");
  std::mt19937_64 random(1);
  for (int i = 0; i < 10'000; ++i) {
    Vector3d up;
    for (double& c : up) {
      const std::uint64_t bits = random();
      std::memcpy(&c, &bits, sizeof c);
    }
    if (up.allFinite()) {
      EXPECT_EQ(parse_up(format_up(up)), up);
    } else {
      EXPECT_THROW(parse_up(format_up(up)), std::invalid_argument) << format_up(up);
    }
  }
}

TEST(Up, DirectionIsOfUnitLengthAndExactAlongAnAxis) {
  for (const double length : {5e-324, 1e-300, 0.3, 1.0, 7.0, 1e300, std::numeric_limits<double>::max()}) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      EXPECT_EQ(normalized_up(length * Vector3d::Unit(i)), Vector3d::Unit(i)) << length;
      const Vector3d down = normalized_up(-length * Vector3d::Unit(i));
      EXPECT_EQ(down, -Vector3d::Unit(i)) << length;
      EXPECT_FALSE(std::signbit(down[(i + 1) % 3]) || std::signbit(down[(i + 2) % 3])) << length;
    }
    EXPECT_NEAR(normalized_up({length, -length, length}).norm(), 1, 1e-15) << length;
  }
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d any = random_direction(random), up = normalized_up(any);
    EXPECT_NEAR(up.norm(), 1, 1e-15);
    EXPECT_NEAR(up.dot(any), any.norm(), 1e-14);
    for (const int power : {-900, -1, 1, 2, 900})
      EXPECT_EQ(normalized_up(std::ldexp(1, power) * any), up) << power;
  }
}

TEST(Up, WithoutADirectionIsRefused) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal([] { normalized_up({0, -0.0, 0}); }), "up is 0,-0,0, must be finite and not 0");
  EXPECT_THAT(refusal([&] { normalized_up({0, inf, 1}); }), HasSubstr("up is 0,inf,1, must be finite"));
  EXPECT_THAT(refusal([] { normalized_up({NAN, 0, 1}); }), HasSubstr("up is nan,0,1, must be finite"));
}

TEST(UpFrame, OfAnAxisAreTheAxesAfterIt) {
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (const double length : {1.0, -1.0, 0.1, -5.0}) {
      const UpFrame frame(length * Vector3d::Unit(i));
      EXPECT_EQ(frame.up, std::copysign(1, length) * Vector3d::Unit(i));
      EXPECT_EQ(frame.u, Vector3d::Unit((i + 1) % 3));
      EXPECT_EQ(frame.v, Vector3d::Unit((i + 2) % 3));
    }
  }
}

TEST(UpFrame, IsOfUnitVectorsAtRightAngles) {
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    const UpFrame frame(random_direction(random));
    Eigen::Matrix3d axes;
    axes << frame.u, frame.v, frame.up;
    EXPECT_LE((axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(UpFrame, TurnsFromAnAxisAsFarAsUpDoes) {
  std::mt19937 random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d axis = (i % 2 ? 1 : -1) * Vector3d::Unit(i % 3);
    const UpFrame upright(axis), tilted(axis + 0.1 * random_direction(random).normalized());
    const double moved = (tilted.up - upright.up).norm();
    EXPECT_LE((tilted.u - upright.u).norm(), moved + 1e-15);
    EXPECT_LE((tilted.v - upright.v).norm(), moved + 1e-15);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
