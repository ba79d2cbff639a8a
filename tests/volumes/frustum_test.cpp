// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "meshes.h"
#include "pair_volumes.h"
#include "pcl_bv/volumes/pair_queries.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;
using testing::Random;

constexpr unsigned kSeed = 3;

TEST(Frustum, LooksAlongZ) {
  const Hull seen = frustum(Eigen::Isometry3d::Identity(), 1, 10, 0.5, 0.25);
  EXPECT_TRUE(seen.contains({0, 0, 5}));
  EXPECT_TRUE(seen.contains({2.4, 1.2, 5}));
  EXPECT_FALSE(seen.contains({2.6, 0, 5}));
  EXPECT_FALSE(seen.contains({0, 1.3, 5}));
  EXPECT_FALSE(seen.contains({0, 0, 0.9}));
  EXPECT_FALSE(seen.contains({0, 0, 10.1}));
  EXPECT_FALSE(seen.contains({0, 0, -5}));
}

TEST(Frustum, MeasuresAsAPyramidThatIsCutOff) {
  const Hull seen = frustum(Eigen::Isometry3d::Identity(), 1, 3, 0.5, 0.25);
  EXPECT_NEAR(seen.volume(), (27.0 - 1.0) / 3 * 0.5, 1e-13);  // 4 h v (far^3 - near^3) / 3
  EXPECT_EQ(seen.vertices().size(), 8u);
  EXPECT_EQ(seen.triangles().size(), 12u);
  EXPECT_EQ(seen.planes().size(), 6u);
  EXPECT_EQ(seen.rank(), 3);
}

TEST(Frustum, HasAClosedMeshWithTwoTrianglesInEachPlane) {
  const Hull seen = frustum(Eigen::Isometry3d::Identity(), 1, 3, 0.5, 0.25);
  testing::expect_closed(seen.mesh());
  Mesh triangles{seen.vertices(), {}};
  for (const Hull::Triangle& triangle : seen.triangles())
    triangles.faces.emplace_back(triangle.begin(), triangle.end());
  testing::expect_closed(triangles);
  for (const HullPlane& plane : seen.planes()) {
    const auto is_in_plane = [&](const Hull::Triangle& triangle) {
      return std::all_of(triangle.begin(), triangle.end(), [&](auto i) {
        const Vector3d& vertex = seen.vertices()[static_cast<std::size_t>(i)];
        return std::abs(plane.normal.dot(vertex) - plane.offset) < 1e-14;
      });
    };
    EXPECT_EQ(std::count_if(seen.triangles().begin(), seen.triangles().end(), is_in_plane), 2);
  }
}

TEST(Frustum, PlanesHoldAllVerticesByExactArithmetic) {
  Random random(kSeed);
  for (const testing::Scale& scale : testing::scales()) {
    if (scale.extent > 1e38) continue;
    for (int round = 0; round < 20; ++round) {
      Eigen::Isometry3d pose = random.isometry(1);
      pose.translation() = random.point(scale);
      const double near = scale.extent * random.uniform(0, 1);
      const Hull seen =
          frustum(pose, near, near + scale.extent, random.uniform(0.1, 3), random.uniform(0.1, 3));
      for (const Vector3d& v : seen.vertices())
        EXPECT_TRUE(testing::inside(seen, testing::exact(v))) << scale.name;
    }
  }
}

TEST(Frustum, IsTheImageOfThatOfACameraAtHome) {
  Random random(kSeed);
  for (int round = 0; round < 200; ++round) {
    const Eigen::Isometry3d pose = random.isometry(5);
    const Hull seen = frustum(pose, 0.5, 4, 0.7, 0.4);
    const Vector3d p = random.vector(5);
    const bool expected =
        p.z() >= 0.5 && p.z() <= 4 && std::abs(p.x()) <= 0.7 * p.z() && std::abs(p.y()) <= 0.4 * p.z();
    EXPECT_EQ(seen.contains(pose * p), expected);
  }
}

TEST(Frustum, OfNearZeroIsAPyramid) {
  const Hull seen = frustum(Eigen::Isometry3d::Identity(), 0, 3, 1, 1);
  EXPECT_TRUE(seen.contains({0, 0, 0}));
  EXPECT_NEAR(seen.volume(), 36, 1e-12);
  EXPECT_NEAR(distance(seen, Sphere({0, 0, -2}, 0.5)), 1.5, 1e-13);
}

TEST(Frustum, MeetsWhatItSees) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Vector3d(5e6, -5e6, 100);
  const ConvexBody seen(frustum(pose, 1, 50, 1, 0.5));
  const auto ball = [&](double x, double y, double z) {
    return ConvexBody(Sphere(pose * Vector3d(x, y, z), 0.5));
  };
  EXPECT_TRUE(overlaps(seen, ball(0, 0, 10)));
  EXPECT_TRUE(overlaps(seen, ball(10.4, 0, 10)));  // partly
  EXPECT_FALSE(overlaps(seen, ball(11, 0, 10)));
  EXPECT_FALSE(overlaps(seen, ball(0, 0, 0.4)));
  EXPECT_FALSE(overlaps(seen, ball(0, 0, -3)));
  EXPECT_TRUE(within(seen, ball(11, 0, 10), 0.3));
}

TEST(Frustum, RefusesWhatIsNone) {
  const Eigen::Isometry3d id = Eigen::Isometry3d::Identity();
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto refused = [](const Eigen::Isometry3d& pose, double near, double far, double h, double v) {
    try {
      frustum(pose, near, far, h, v);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(id, -1, 2, 1, 1), "frustum: near is -1, must be at least 0 and below far");
  EXPECT_EQ(refused(id, 1, 2, 0, 1), "frustum: horizontal_tan is 0, must be above 0 and at most 1e6");
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_NE(refused(id, bad, 2, 1, 1), "");
    EXPECT_NE(refused(id, 1, bad, 1, 1), "");
    EXPECT_NE(refused(id, 1, 2, bad, 1), "");
    EXPECT_NE(refused(id, 1, 2, 1, bad), "");
    Eigen::Isometry3d pose = id;
    pose.translation().y() = bad;
    EXPECT_NE(refused(pose, 1, 2, 1, 1), "");
    pose = id;
    pose.linear()(0, 1) = bad;
    EXPECT_NE(refused(pose, 1, 2, 1, 1), "");
  }
  EXPECT_NE(refused(id, 2, 2, 1, 1), "");
  EXPECT_EQ(refused(id, 1, 2, 1e6, 1e6) + refused(id, 1, 2, 1e-6, 1e-6), "");
  EXPECT_NE(refused(id, 1, 2, 1.01e6, 1), "");
  EXPECT_NE(refused(id, 1, 2, 1, 1.01e6), "");
  Eigen::Isometry3d skewed = id;
  skewed.linear()(0, 1) = 0.9e-6;
  EXPECT_EQ(refused(skewed, 1, 2, 1, 1), "");
  skewed.linear()(0, 1) = 1.1e-6;
  EXPECT_NE(refused(skewed, 1, 2, 1, 1), "");
  Eigen::Isometry3d mirrored = id;
  mirrored.linear()(0, 0) = -1;
  EXPECT_NE(refused(mirrored, 1, 2, 1, 1), "");
}

}  // namespace
}  // namespace pcl_bv::detail
