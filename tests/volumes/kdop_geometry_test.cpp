// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the k-DOP as a polytope: measures known by hand and closed meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "exact.h"
#include "kdop_sets.h"
#include "meshes.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Vector3d;

// The cube |x|, |y|, |z| <= 1 with the other slabs at |s| <= reach.
Kdop cut_cube(const std::shared_ptr<const KdopSet>& set, double diagonal, double edge) {
  SlabVector max(static_cast<Eigen::Index>(set->size()));
  for (std::size_t i = 0; i < set->size(); ++i) {
    const double ones = set->direction(i).squaredNorm();
    max[static_cast<Eigen::Index>(i)] = ones == 1 ? 1 : ones == 2 ? edge : diagonal;
  }
  return {set, -max, max};
}

double mesh_volume(const Mesh& mesh) {
  double six = 0;
  const Vector3d apex = mesh.vertices.front();
  for (const auto& f : mesh.faces) {
    for (std::size_t i = 1; i + 1 < f.size(); ++i) {
      six += (mesh.vertices[f[0]] - apex)
                 .dot((mesh.vertices[f[i]] - apex).cross(mesh.vertices[f[i + 1]] - apex));
    }
  }
  return six / 6;
}

TEST(KdopShape, UncutCubeIsTheCubeForEverySet) {
  for (const auto& set : {KdopSet::dop6(), KdopSet::dop14(), KdopSet::dop18(), KdopSet::dop26()}) {
    SCOPED_TRACE(set->size());
    for (const double reach : {3.0, 50.0}) {  // touching the corners, and far away
      const Kdop cube = cut_cube(set, reach, reach);
      EXPECT_DOUBLE_EQ(cube.volume(), 8);
      EXPECT_DOUBLE_EQ(cube.surface_area(), 24);
      EXPECT_EQ(cube.corners().size(), 8u);
      EXPECT_EQ(cube.mesh().faces.size(), 6u);
      EXPECT_LT(cube.center().norm(), 1e-15);
      expect_closed(cube.mesh());
    }
  }
}

TEST(KdopShape, CubeWithCutCornersHasTheVolumeComputedByHand) {
  // Each corner loses a tetrahedron with three edges of length 3 - 2.5; its triangle has sides 0.5 sqrt 2.
  const Kdop kdop = cut_cube(KdopSet::dop14(), 2.5, 0);
  EXPECT_NEAR(kdop.volume(), 8 - 8 * 0.125 / 6, 1e-14);
  EXPECT_NEAR(kdop.surface_area(), 24 - 8 * 3 * 0.125 + 8 * std::sqrt(3) / 4 * 0.5, 1e-13);
  EXPECT_EQ(kdop.corners().size(), 24u);
  EXPECT_EQ(kdop.mesh().faces.size(), 14u);
  expect_closed(kdop.mesh());
}

TEST(KdopShape, CutToTheMiddleOfTheEdgesIsACuboctahedron) {
  const Kdop kdop = cut_cube(KdopSet::dop14(), 2, 0);
  EXPECT_NEAR(kdop.volume(), 8 - 8.0 / 6, 1e-14);
  EXPECT_EQ(kdop.corners().size(), 12u);
  EXPECT_EQ(kdop.mesh().faces.size(), 14u);
  expect_closed(kdop.mesh());
}

TEST(KdopShape, OctahedronIsTheHullOfSixPoints) {
  Kdop kdop(KdopSet::dop14());
  for (int k = 0; k < 3; ++k)
    kdop.extend(Vector3d::Unit(k)).extend(-Vector3d::Unit(k));
  EXPECT_NEAR(kdop.volume(), 4.0 / 3, 1e-14);
  EXPECT_NEAR(kdop.surface_area(), 4 * std::sqrt(3), 1e-13);
  EXPECT_EQ(kdop.corners().size(), 6u);
  expect_closed(kdop.mesh());
}

TEST(KdopShape, CutEdgesMakeARhombicDodecahedron) {
  // |x +- y| <= 1 and so on: edge length sqrt(3)/2, volume 16/9 sqrt(3) a^3 = 2, area 8 sqrt(2) a^2 = 6
  // sqrt(2).
  const Kdop kdop = cut_cube(KdopSet::dop18(), 0, 1);
  EXPECT_NEAR(kdop.volume(), 2, 1e-14);
  EXPECT_NEAR(kdop.surface_area(), 6 * std::sqrt(2), 1e-13);
  EXPECT_EQ(kdop.corners().size(), 14u);
  EXPECT_EQ(kdop.mesh().faces.size(), 12u);
  expect_closed(kdop.mesh());
}

TEST(KdopShape, TwentySixDopCutByHand) {
  // Edge slabs at 1.75 take a triangular prism of legs 0.25 along each of the 12 edges; seen by inclusion and
  // exclusion at a corner: all of u + v < 0.25 for some pair of distances u, v, w of the faces.
  const double a = 0.25;
  const Kdop kdop = cut_cube(KdopSet::dop26(), 3, 2 - a);
  const double prism = a * a / 2 * 2;  // over the edge's whole length, 2
  // Two prisms of a corner meet in u + v < a, u + w < a: a^3 / 3. All three: u, v, w pairwise below a: a^3
  // / 4.
  const double corner = 3 * (a * a * a / 3) - a * a * a / 4;
  EXPECT_NEAR(kdop.volume(), 8 - (12 * prism - 8 * corner), 1e-13);
  expect_closed(kdop.mesh());
}

TEST(KdopShape, SimplexHasItsVolumeAndCentreOfMass) {
  const Kdop kdop =
      Kdop(KdopSet::dop26()).extend({0, 0, 0}).extend({1, 0, 0}).extend({0, 1, 0}).extend({0, 0, 1});
  EXPECT_NEAR(kdop.volume(), 1.0 / 6, 1e-15);
  EXPECT_TRUE(kdop.center().isApprox(Vector3d::Constant(0.25), 1e-14));
  EXPECT_EQ(kdop.corners().size(), 4u);
  EXPECT_NEAR(kdop.distance({1, 1, 1}), 2 / std::sqrt(3), 1e-15) << "from a face";
  EXPECT_NEAR(kdop.distance({-3, -4, 0.5}), 5, 1e-15) << "from an edge";
  EXPECT_NEAR(kdop.distance({3, -1, -2}), 3, 1e-15) << "from a corner";
}

TEST(KdopShape, BoxOf6DopIsExactAtEverySize) {
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    const Vector3d low(scale.offset, scale.offset, scale.offset),
        size(scale.extent, scale.extent, scale.extent);
    const Kdop kdop = Kdop(KdopSet::dop6()).extend(low).extend(low + size);
    EXPECT_DOUBLE_EQ(kdop.volume(), kdop.aabb().volume());
    EXPECT_DOUBLE_EQ(kdop.surface_area(), kdop.aabb().surface_area());
    EXPECT_EQ(kdop.aabb(), Aabb(low, low + size));
  }
}

TEST(KdopShape, AVeryLongThinBoxKeepsItsVolume) {
  const Kdop kdop =
      Kdop().extend({0, 0, 0}).extend({1e20, 1, 1e-3}).extend({1e20, 0, 0}).extend({0, 1, 1e-3});
  EXPECT_GT(kdop.volume(), 0);
  EXPECT_LE(kdop.volume(), kdop.aabb().volume() * (1 + 1e-14));
}

TEST(KdopShape, VolumeIsHomogeneousAtEverySize) {
  Random random(31);
  const auto points = random.cloud({"", 0, 1}, Span::solid, 10);
  const Kdop unit = around(Kdop(), points);
  for (const double size : {0x1p-136, 0x1p-66, 0x1p66, 0x1p126, 0x1p300}) {
    Kdop scaled;
    for (const Vector3d& p : points)
      scaled.extend(size * p);
    EXPECT_DOUBLE_EQ(scaled.volume() / size / size / size, unit.volume());
    EXPECT_DOUBLE_EQ(scaled.surface_area() / size / size, unit.surface_area());
    EXPECT_EQ(scaled.corners().size(), unit.corners().size());
  }
}

TEST(KdopShape, VolumeSurvivesTheOffsetOfUtm) {
  const Vector3d utm(500000.25, 5400000.5, 300.125);
  Kdop near, far;
  Random random(32);
  for (int i = 0; i < 20; ++i) {
    const Vector3d p = (random.vector(1) * 0x1p20).array().round() * 0x1p-20;  // so that p + utm is exact
    near.extend(p);
    far.extend(p + utm);
  }
  EXPECT_NEAR(far.volume(), near.volume(), 1e-13);
  EXPECT_NEAR(far.surface_area(), near.surface_area(), 1e-13);
  EXPECT_LT((far.center() - utm - near.center()).norm(), 2e-9);
}

TEST(KdopShape, RandomCloudsGiveClosedMeshesNoBiggerThanTheirBox) {
  Random random(33);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
      for (int i = 0; i < 10; ++i) {
        const Kdop kdop = around(Kdop(set), random.cloud(scale, Span::solid, 4 + i * i));
        const Mesh mesh = kdop.mesh();
        expect_closed(mesh);
        EXPECT_LE(kdop.volume(), kdop.aabb().volume() * (1 + 1e-14));
        if (scale.offset == 0 && scale.extent > 1e-41 && scale.extent < 1e41) {
          EXPECT_NEAR(kdop.volume(), mesh_volume(mesh), 1e-12 * kdop.aabb().volume());
        }
        for (const Vector3d& v : mesh.vertices) {
          EXPECT_LE(kdop.distance(v), 1e-13 * scale.extent + 1e-15 * scale.offset);
        }
      }
    }
  }
}

TEST(KdopShape, AFlatSquareHasTwoSides) {
  const Kdop kdop = Kdop().extend({0, 0, 5}).extend({1, 0, 5}).extend({1, 1, 5}).extend({0, 1, 5});
  EXPECT_EQ(kdop.volume(), 0);
  EXPECT_DOUBLE_EQ(kdop.surface_area(), 2);
  EXPECT_EQ(kdop.corners().size(), 4u);
  EXPECT_EQ(kdop.mesh().faces.size(), 2u);
  EXPECT_TRUE(kdop.center().isApprox(Vector3d(0.5, 0.5, 5)));
  EXPECT_DOUBLE_EQ(kdop.distance({0.5, 0.5, 8}), 3);
  EXPECT_DOUBLE_EQ(kdop.distance({4, 0.5, 9}), 5);
}

TEST(KdopShape, ATiltedFlatTriangleIsAHexagonsPart) {
  // x + y + z = 1 is one of the slabs, with width 0; within it the others leave exactly the triangle.
  const Kdop kdop = Kdop(KdopSet::dop14()).extend({1, 0, 0}).extend({0, 1, 0}).extend({0, 0, 1});
  EXPECT_EQ(kdop.volume(), 0);
  EXPECT_NEAR(kdop.surface_area(), std::sqrt(3), 1e-14);
  EXPECT_EQ(kdop.corners().size(), 3u);
  EXPECT_TRUE(kdop.center().isApprox(Vector3d::Constant(1.0 / 3)));
}

TEST(KdopShape, ALineHasLengthOnly) {
  const Kdop kdop = Kdop().extend({0, 0, 0}).extend({3, 3, 3});
  EXPECT_EQ(kdop.volume(), 0);
  EXPECT_EQ(kdop.surface_area(), 0);
  EXPECT_EQ(kdop.corners().size(), 2u);
  EXPECT_TRUE(kdop.center().isApprox(Vector3d::Constant(1.5)));
  EXPECT_NEAR(kdop.distance({1, 1, 4}), std::sqrt(6), 1e-14);
  EXPECT_DOUBLE_EQ(kdop.distance({3, 3, 5}), 2);
}

TEST(KdopShape, APointHasACorner) {
  for (const Vector3d& p :
       {Vector3d(0.1, 0.2, 0.3), Vector3d(5e6 + 0.1, 5e6 + 0.7, 1), Vector3d(1e20, 1, 1e20)}) {
    const Kdop kdop = Kdop().extend(p);
    EXPECT_EQ(kdop.volume(), 0);
    EXPECT_EQ(kdop.surface_area(), 0);
    ASSERT_EQ(kdop.corners().size(), 1u);
    EXPECT_EQ(kdop.corners()[0], p);
    EXPECT_EQ(kdop.center(), p);
    EXPECT_EQ(kdop.support({1, 2, 3}), p);
  }
  EXPECT_DOUBLE_EQ(Kdop().extend({1, 1, 1}).distance({4, 5, 1}), 5);
}

TEST(KdopShape, FlatCloudsOfAnyTiltAndSizeHaveNoVolumeToSpeakOf) {
  Random random(34);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      for (const Span span : {Span::line, Span::point}) {
        SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
        const Kdop kdop = around(Kdop(set), random.cloud(scale, span, 10));
        EXPECT_FALSE(kdop.corners().empty());
        EXPECT_TRUE(kdop.center().allFinite());
        EXPECT_LE(kdop.volume(), kdop.aabb().volume() * (1 + 1e-14));
      }
    }
  }
}

TEST(KdopShape, SlabsThatDoNotMeetHaveNoCorners) {
  SlabVector min(7), max(7);
  min << 0, 0, 0, 100, -9, -9, -9;
  max << 1, 1, 1, 101, 9, 9, 9;
  const Kdop kdop(KdopSet::dop14(), min, max);
  EXPECT_EQ(kdop.volume(), 0);
  EXPECT_TRUE(kdop.corners().empty());
  EXPECT_TRUE(kdop.center().array().isNaN().all()) << kdop.center().transpose();
  EXPECT_EQ(kdop.distance({0, 0, 0}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace pcl_bv::detail
