// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is inside a volume by exact arithmetic is inside for each of its member functions, for masks and
// trees: points just below the surface, of fitted volumes and of moved ones.

#include <gtest/gtest.h>

#include <random>

#include "executions.h"
#include "fits.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/trees/region_mask.h"
#include "pcl_bv/trees/volume_tree.h"
#include "pcl_bv/volumes/pair_queries.h"
#include "uneven_cloud.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;

bool is_inside(const AnyVolume& volume, const Vector3d& p) {
  return verify(volume, PointView::of(p.data(), sizeof p, 1)).outside == 0;
}

// The last point on the way from one inside to another that is inside by exact arithmetic.
Vector3d last_inside(const AnyVolume& volume, Vector3d in, Vector3d out) {
  if (is_inside(volume, out)) return out;
  for (int step = 0; step < 1100; ++step) {
    const Vector3d middle = 0.5 * in + 0.5 * out;
    if (middle == in || middle == out) break;
    (is_inside(volume, middle) ? in : out) = middle;
  }
  return in;
}

Eigen::Isometry3d some_motion(std::mt19937_64& random, double size) {
  std::normal_distribution<double> normal;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                        .normalized()
                        .toRotationMatrix();
  motion.translation() = size * Vector3d(normal(random), normal(random), normal(random));
  return motion;
}

void expect_inside_of_all(const AnyVolume& volume, const Vector3d& p, const std::string& name) {
  const Aabb box = aabb(volume);
  EXPECT_TRUE((box.min().array() <= p.array()).all() && (p.array() <= box.max().array()).all())
      << name << ": aabb, by " << (box.min() - p).cwiseMax(p - box.max()).transpose();
  EXPECT_TRUE(contains(volume, p)) << name;
  EXPECT_EQ(distance(volume, p), 0) << name;
  EXPECT_TRUE(overlaps(volume, Sphere(p, 0))) << name;
  EXPECT_EQ(distance(volume, AnyVolume(Aabb(p, p))), 0) << name;
  const auto ray = intersect(volume, p, Vector3d(1, 2, -3));
  EXPECT_TRUE(ray && ray->enter == 0) << name;
  std::vector<std::uint8_t> marks;
  RegionMask({{volume, 0}}).mark(PointView::of(p.data(), sizeof p, 1), marks);
  EXPECT_EQ(marks.front(), 1) << name << ": mask";
  EXPECT_TRUE(VolumeTree({volume}).any_containing(p)) << name << ": tree";
}

void expect_members_agree(const AnyVolume& volume, const Vector3d& inside, const std::string& name) {
  const Aabb box = aabb(volume);
  const double rounding =
      1e-12 * std::max((box.max() - box.min()).maxCoeff(), box.max().cwiseAbs().maxCoeff());
  for (const Vector3d& corner : mesh(volume).vertices)
    EXPECT_LE(distance(AnyVolume(box), corner), rounding) << name << ": mesh";
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const Vector3d size = (box.max() - box.min()).cwiseMax(1e-300);
  for (int i = 0; i < 6; ++i) {
    const Vector3d d(normal(random), normal(random), normal(random));
    const Vector3d along = i % 2 == 0 ? d : Vector3d(d.cwiseQuotient(size / size.maxCoeff()));
    const Vector3d farthest = support(volume, along);
    EXPECT_LE(distance(AnyVolume(box), farthest), rounding) << name << ": support";
    EXPECT_LE(distance(volume, farthest), rounding) << name << ": support";
    // Towards the farthest point, where planes that meet at a small angle reach beyond it, and anywhere.
    for (const Vector3d& to :
         {Vector3d(inside + 1.5 * (farthest - inside)), Vector3d(inside + 2 * d.cwiseProduct(size))})
      expect_inside_of_all(volume, last_inside(volume, inside, to), name);
  }
}

template <typename T>
void expect_agreement(int seed) {
  const test::TestCloud<T> cloud = test::uneven_cloud<T>(seed);
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  const PointView points = cloud.view();
  for (const Method& method : methods()) {
    AnyVolume volume;
    if (test::take(method.fit(points), volume).used == 0) continue;
    const std::string name = std::string(method.name) + ", " + cloud.name;
    const Vector3d inside = vector(load_point(points, 0));
    expect_members_agree(volume, inside, name);
    const Aabb box = aabb(volume);
    const AnyVolume moved = transformed(volume, some_motion(random, (box.max() - box.min()).maxCoeff()));
    const Vector3d in_moved = center(moved);
    if (is_inside(moved, in_moved)) expect_members_agree(moved, in_moved, name + ", moved");
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Members, OfAVolumeAgreeOnPointsJustInsideByExactArithmetic) {
  for (int seed = 0; seed < (test::kFewCases ? 2 : 14) && !HasFailure(); ++seed) {
    expect_agreement<double>(seed);
    expect_agreement<float>(seed);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
