// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Directions at every distance from a coordinate axis, down to 2^-1074: rotations by 90 degrees give
// components of 6e-17. Volumes store such axes as they are, and must enclose for the axes that they store.
// PCL_BV_RANDOM_CASES sets the number of cases.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "../volumes/obbs.h"
#include "../volumes/round_volumes.h"
#include "encloses.h"
#include "few_cases.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/partial.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::size_t case_count() {
  if (const char* const wanted = std::getenv("PCL_BV_RANDOM_CASES")) return std::stoul(wanted);
  return test::kFewCases ? 300 : 10'000;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::size_t below(std::size_t count) { return engine_() % count; }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double sign() { return below(2) == 0 ? 1 : -1; }

  // A number of random digits and the magnitude 2^-exponent, or a small power of two.
  double tiny(int exponent) { return sign() * std::ldexp(below(2) == 0 ? 1 : uniform(1, 2), -exponent); }

  // 0 to 1074, mostly below 100.
  int exponent() { return static_cast<int>(below(below(4) == 0 ? 1075 : 100)); }

  // A direction near a coordinate axis or opposite to one. Its other components are 0, or from 1 to 2^-1074.
  Vector3d nearly_axis() {
    Vector3d direction;
    for (double& component : direction)
      component = below(4) == 0 ? sign() * 0.0 : tiny(exponent());
    if (below(8) == 0) direction[below(3)] = sign() * 6.123233995736766e-17;
    direction[below(3)] = sign();
    if (below(3) == 0) direction *= std::ldexp(uniform(1, 2), static_cast<int>(below(190)) - 95);
    return direction;
  }

  // 1 to 12 points. The magnitude differs from axis to axis, or is the same for all. Coordinates may be few
  // different numbers, as those of walls are.
  std::vector<Vector3d> cloud(int lowest_exponent, int highest_exponent) {
    const auto scale = [&] {
      const auto range = static_cast<std::size_t>(highest_exponent - lowest_exponent + 1);
      return std::ldexp(1.0, lowest_exponent + static_cast<int>(below(range)));
    };
    Vector3d scales = Vector3d::Constant(scale()), offset = Vector3d::Zero();
    for (int k = 0; k < 3 && below(2) == 0; ++k)
      scales[k] = scale();
    if (below(4) == 0) offset = uniform(-1000, 1000) * scales;
    const bool lattice = below(3) == 0;
    std::vector<Vector3d> points(1 + below(12));
    for (Vector3d& p : points) {
      for (int k = 0; k < 3; ++k) {
        const double at = uniform(-2, 2);
        p[k] = offset[k] + scales[k] * (lattice ? std::round(at) : at);
      }
      p = p.cwiseMin(1e100).cwiseMax(-1e100);
    }
    return points;
  }

 private:
  std::mt19937_64 engine_;
};

PointView view_of(const std::vector<Vector3d>& points) {
  return PointView::of(points.data()->data(), sizeof points[0], points.size());
}

std::string text_of(const Vector3d& v) {
  char text[120];
  std::snprintf(text, sizeof text, "%a,%a,%a", v.x(), v.y(), v.z());
  return text;
}

// Fails, and names the case, unless the volume holds all points in exact arithmetic.
void expect_holds(const AnyVolume& volume, const std::vector<Vector3d>& points, const std::string& what) {
  SCOPED_TRACE(what);
  test::expect_encloses(volume, view_of(points));
}

TEST(NearlyAxis, UprightVolumesHoldEveryPointForTheAxesThatTheyStore) {
  Random random(77);
  for (std::size_t i = 0; i < case_count() && !::testing::Test::HasFailure(); ++i) {
    const Vector3d up = random.nearly_axis();
    const std::vector<Vector3d> points = i % 8 == 0 ? random.cloud(-996, 331) : random.cloud(-20, 20);
    double extent = 0;
    for (const Vector3d& p : points)
      extent = std::max(extent, (p - points[0]).cwiseAbs().maxCoeff());
    const PointView view = view_of(points);
    const std::string what = "case " + std::to_string(i) + ", up " + text_of(up);
    expect_holds(fit_prism(view, up).volume, points, what + ", prism");
    expect_holds(fit_obb(view, {ObbMethod::yaw, up}).volume, points, what + ", obb-yaw");
    if (i % 4 == 0)
      expect_holds(fit_obb(view, {ObbMethod::lshape, up}).volume, points, what + ", obb-lshape");
    if (i % 4 == 1 && extent > 0)
      expect_holds(fit_prism(view, {up, extent / 4}).volume, points, what + ", concave prism");
  }
}

TEST(NearlyAxis, SlabsHoldEveryPointForTheirDirections) {
  Random random(78);
  for (std::size_t i = 0; i < case_count() / 4 && !::testing::Test::HasFailure(); ++i) {
    std::vector<Vector3d> directions;
    while (directions.size() < 3)
      directions.push_back(random.nearly_axis());
    const std::vector<Vector3d> points = i % 8 == 0 ? random.cloud(-996, 331) : random.cloud(-20, 20);
    Matrix3d all;
    all << directions[0].stableNormalized(), directions[1].stableNormalized(),
        directions[2].stableNormalized();
    if (!(std::abs(all.determinant()) > 0.1)) continue;
    const auto set = std::make_shared<const KdopSet>(directions);
    expect_holds(fit_kdop(view_of(points), set).volume, points, "case " + std::to_string(i));
  }
}

TEST(NearlyAxis, EveryMethodHoldsThePointsOfABoxThatIsNearlyAlongTheAxes) {
  Random random(79);
  for (std::size_t i = 0; i < case_count() / 40 && !::testing::Test::HasFailure(); ++i) {
    Matrix3d turn;
    turn << random.nearly_axis(), Vector3d::UnitX(), Vector3d::Zero();
    if (cross3(turn.col(0), turn.col(1)).norm() < 0.1 * turn.col(0).norm()) turn.col(1) = Vector3d::UnitY();
    turn.col(0).stableNormalize();
    turn = orthonormal_axes(turn);
    std::vector<Vector3d> points = random.cloud(-20, 20);
    for (Vector3d& p : points)
      p = turn * p;
    MethodOptions options;
    options.up = random.nearly_axis();
    for (const Method& method : methods()) {
      const std::string what =
          "case " + std::to_string(i) + ", " + std::string(method.name) + ", up " + text_of(options.up);
      expect_holds(method.fit(view_of(points), options).volume, points, what);
    }
  }
}

// A rotation by about 90 degrees about a coordinate axis, as cosine and sine give it, and a translation.
Eigen::Isometry3d quarter_turn(Random& random, double extent) {
  const double cosine = random.tiny(1 + random.exponent() % 1074);
  const double sine = std::sqrt(1 - cosine * cosine);
  const auto k = static_cast<int>(random.below(3)), first = (k + 1) % 3, second = (k + 2) % 3;
  Matrix3d rotation = Matrix3d::Identity();
  rotation(first, first) = rotation(second, second) = cosine;
  rotation(first, second) = -sine;
  rotation(second, first) = sine;
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() = rotation;
  turn.translation() = extent * Vector3d(random.uniform(-1, 1), 0, random.tiny(40));
  return turn;
}

TEST(NearlyAxis, TransformedVolumesHoldTheExactImagesOfThePoints) {
  Random random(80);
  for (std::size_t i = 0; i < case_count() / 40 && !::testing::Test::HasFailure(); ++i) {
    const std::vector<Vector3d> points = random.cloud(-20, 20);
    const Eigen::Isometry3d transform = quarter_turn(random, points[0].norm());
    MethodOptions options;
    options.up = random.nearly_axis();
    for (const Method& method : methods()) {
      const AnyVolume moved = transformed(method.fit(view_of(points), options).volume, transform);
      for (const Vector3d& p : points) {
        const testing::ExactPoint image = testing::image(transform, testing::exact(p));
        const bool holds = std::visit([&](const auto& v) { return testing::inside(v, image); }, moved);
        EXPECT_TRUE(holds) << "case " << i << ", " << method.name << ", up " << text_of(options.up);
      }
    }
  }
}

TEST(NearlyAxis, PartsGiveTheBitsOfTheWholeCloud) {
  Random random(81);
  for (std::size_t i = 0; i < case_count() / 20 && !::testing::Test::HasFailure(); ++i) {
    const std::vector<Vector3d> points = random.cloud(-20, 20);
    const PointView view = view_of(points);
    const std::size_t half = points.size() / 2;
    Partial parts(PointView::of(points[0].data(), sizeof points[0], half));
    parts.merge(
        Partial(PointView::of(points[0].data() + 3 * half, sizeof points[0], points.size() - half), half));
    MethodOptions options;
    options.up = random.nearly_axis();
    for (const char* const name : {"prism", "obb-yaw"}) {
      const Method& method = *find_method(name);
      EXPECT_EQ(parts.fit(method, options).volume, method.fit(view, options).volume)
          << "case " << i << ", " << name << ", up " << text_of(options.up);
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
