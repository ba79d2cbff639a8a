// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Every upright method has one convention: axis 2 is up, axis 0 the longer horizontal one.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "executions.h"
#include "numbers.h"
#include "obbs.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/partial.h"

namespace pcl_bv::detail {
namespace {

using namespace test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double pi = 3.14159265358979323846;

const std::array<Vector3d, 9> kUps{Vector3d(0, 0, 1),  Vector3d(0, 0, -1),       Vector3d(0, 1, 0),
                                   Vector3d(0, -3, 0), Vector3d(1, 0, 0),        Vector3d(-1, 0, 0),
                                   Vector3d(1, 2, 3),  Vector3d(0.05, -0.02, 4), Vector3d(-2e-20, 1e-20, 0)};

std::vector<const Method*> upright_methods() {
  std::vector<const Method*> found;
  for (const Method& method : methods())
    if (method.upright && method.shape == "obb") found.push_back(&method);
  return found;
}

Matrix3d lift_to(const Vector3d& up) {
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up).toRotationMatrix();
}

// Boxes whose height is the largest, the middle and the smallest extent, with square bases, flat, on a line.
template <typename T>
std::vector<TestCloud<T>> solids(const Vector3d& up) {
  std::vector<TestCloud<T>> clouds;
  for (const Vector3d& half :
       {Vector3d(0.2, 0.1, 4), Vector3d(4, 0.2, 1), Vector3d(4, 2, 0.1), Vector3d(2, 2, 1), Vector3d(1, 1, 5),
        Vector3d(3, 2, 0), Vector3d(3, 0, 1), Vector3d(3, 0, 0), Vector3d(0, 0, 3), Vector3d(0, 0, 0)}) {
    for (const double yaw : {0.0, 0.4, 1.9}) {
      clouds.push_back(box_cloud<T>(half, lift_to(up) * yaw_turn(yaw), {20, -7, 3}, 60, 5));
      clouds.back().name = "half " + std::to_string(half.x()) + " " + std::to_string(half.y()) + " " +
                           std::to_string(half.z()) + " yaw " + std::to_string(yaw);
    }
  }
  clouds.push_back(gaussian<T>(3000, 17));
  return clouds;
}

void expect_upright(const Obb& box, const Vector3d& up) {
  const Vector3d unit = up.normalized();
  EXPECT_LE((box.axis(2) - unit).norm(), 1e-15);
  if (unit.cwiseAbs().maxCoeff() == 1) {
    EXPECT_EQ(box.axis(2), unit) << "exact along an axis of the frame";
  }
  EXPECT_GE(box.half_extents()[0], box.half_extents()[1] - 1e-10 * box.half_extents().maxCoeff() - 1e-12);
  EXPECT_NEAR(box.axes().determinant(), 1, 1e-14);
  EXPECT_TRUE(box.quaternion().toRotationMatrix().isApprox(box.axes(), 1e-14));
  EXPECT_GT(box.yaw(), -pi / 2);
  EXPECT_LE(box.yaw(), pi / 2 + 1e-9);
}

template <typename T>
void every_method_is_upright_on_every_set() {
  for (const Vector3d& up : kUps) {
    for (const TestCloud<T>& cloud : solids<T>(up)) {
      for (const Method* method : upright_methods()) {
        SCOPED_TRACE(std::string(method->name) + ", " + cloud.name);
        AnyVolume first = *method->fit(cloud.view(), {{}, up}, {Serial{}, Isa::scalar});
        expect_upright(std::get<Obb>(first), up);
        EXPECT_EQ(verify(first, cloud.view()).outside, 0U);
        for (const auto& [name, execution] : every_execution()) {
          AnyVolume volume = *method->fit(cloud.view(), {{}, up}, execution);
          EXPECT_EQ(bits(volume), bits(first)) << name;
        }
      }
    }
  }
}

TEST(UprightBoxes, HaveTheirThirdAxisUpOnEveryInstructionSetAndThreadCount) {
  ASSERT_EQ(upright_methods().size(), 2U);
  every_method_is_upright_on_every_set<float>();
  every_method_is_upright_on_every_set<double>();
}

TEST(UprightBoxes, HaveLengthWidthAndHeightAlongTheirAxes) {
  for (const ObbMethod method : kUpright) {
    for (const Vector3d& up : kUps) {
      for (const Vector3d& half : {Vector3d(0.3, 0.2, 4), Vector3d(4, 2, 0.1), Vector3d(4, 1, 2)}) {
        const auto cloud = box_cloud<double>(half, lift_to(up) * yaw_turn(0.5), {20, -7, 3}, 400, 6);
        const Obb box = fit(cloud, ObbOptions(method, up));
        EXPECT_NEAR(box.half_extents().z(), half.z(), 1e-12) << "the height is along axis 2";
        if (method != ObbMethod::yaw) continue;  // closeness may prefer another yaw inside a solid block
        EXPECT_NEAR(box.half_extents().x(), half.x(), 1e-12);
        EXPECT_NEAR(box.half_extents().y(), half.y(), 1e-12);
      }
    }
  }
}

TEST(UprightBoxes, OfNothingAreEmptyForAnyUp) {
  const TestCloud<float> nothing{"", {}};
  for (const Vector3d& up : kUps)
    for (const ObbMethod method : kUpright)
      EXPECT_TRUE(fit(nothing, ObbOptions(method, up)).empty());
}

TEST(UprightBoxes, OfPartsAreThoseOfTheWholeOnEveryInstructionSet) {
  for (const Vector3d& up : kUps) {
    const TestCloud<float> cloud = gaussian<float>(3000, 18);
    for (const auto& [name, execution] : every_execution()) {
      SCOPED_TRACE(name);
      Partial whole(cloud.view().slice(0, 1700), 0, execution);
      whole.merge(Partial(cloud.view().slice(1700, 1300), 0, execution));
      AnyVolume merged = *whole.fit(*find_method("obb-yaw"), {{}, up}, execution);
      expect_upright(std::get<Obb>(merged), up);
      EXPECT_EQ(std::get<Obb>(merged), fit(cloud, ObbOptions(ObbMethod::yaw, up)));
    }
  }
}

// The sides of a car of 4 x 2 m, with points every 5 cm at three heights: two sides or all four.
TestCloud<double> sides_of_car(double yaw, int sides, double noise, std::uint64_t seed) {
  TestCloud<double> cloud{"car", {}};
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto add = [&](double x, double y) {
    for (const double z : {0.0, 0.5, 1.0}) {
      const Vector3d error = noise * Vector3d(normal(random), normal(random), 0);
      for (const double c : Vector3d(yaw_turn(yaw) * (Vector3d(x, y, z) + error) + Vector3d(10, 5, 0)))
        cloud.xyz.push_back(c);
    }
  };
  for (int side = 0; side < sides / 2; ++side) {
    for (int i = 0; i <= 80; ++i)
      add(-2 + 0.05 * i, side == 0 ? -1 : 1);
    for (int i = 0; i <= 40; ++i)
      add(side == 0 ? -2 : 2, -1 + 0.05 * i);
  }
  return cloud;
}

TEST(UprightBoxes, LShapeHasTheYawOfPerpendicularLinesToAFractionOfADegree) {
  for (const int sides : {2, 4}) {
    for (const auto& [noise, largest_error] : {std::pair(0.0, 1e-4), std::pair(0.02, 0.3)}) {
      for (int i = 0; i < 70; ++i) {
        const double yaw = (0.3 + i * 90.0 / 70) * pi / 180;
        const Obb box = fit(sides_of_car(yaw, sides, noise, 1 + i), ObbMethod::lshape);
        const double quarters = (box.yaw() - yaw) / (pi / 2);
        const double error = std::abs(quarters - std::round(quarters)) * 90;
        EXPECT_LT(error, largest_error) << sides << " sides, noise " << noise << ", yaw " << yaw;
        if (noise == 0) {
          EXPECT_NEAR(4 * box.half_extents()[0] * box.half_extents()[1], 8, 1e-4) << yaw;
        }
      }
    }
  }
}

TEST(UprightBoxes, LShapeTurnsNoMoreThanTheCar) {
  for (const double noise : {0.0, 0.02}) {
    double before = 0;
    for (int i = 0; i < 100; ++i) {
      const double turned = fit(sides_of_car(0.6 + 0.1 * i * pi / 180, 2, noise, 7), ObbMethod::lshape).yaw();
      if (i > 0) {
        EXPECT_NEAR((turned - before) * 180 / pi, 0.1, noise == 0 ? 1e-4 : 0.15) << i;
      }
      before = turned;
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
