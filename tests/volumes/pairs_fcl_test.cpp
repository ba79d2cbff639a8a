// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Distances against those of FCL, where it is installed and has the kind.
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "pair_volumes.h"
#include "pcl_bv/volumes/pair_queries.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;
using testing::Form;
using testing::Random;

constexpr unsigned kSeed = 11;

std::shared_ptr<fcl::CollisionGeometryd> peer_of(const AnyVolume& v) {
  if (const auto* box = std::get_if<Obb>(&v)) {
    return std::make_shared<fcl::Boxd>(Vector3d(2 * box->half_extents()));
  }
  if (const auto* sphere = std::get_if<Sphere>(&v)) return std::make_shared<fcl::Sphered>(sphere->radius());
  if (const auto* c = std::get_if<Cylinder>(&v)) {
    return std::make_shared<fcl::Cylinderd>(c->radius(), 2 * c->half_height());
  }
  if (const auto* c = std::get_if<Capsule>(&v)) {
    return std::make_shared<fcl::Capsuled>(c->radius(), (c->b() - c->a()).norm());
  }
  return std::make_shared<fcl::Ellipsoidd>(std::get<Ellipsoid>(v).radii());
}

Eigen::Isometry3d peer_pose(const AnyVolume& v) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = center(v);
  const auto along = [&](const Vector3d& axis) {
    pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix();
  };
  if (const auto* box = std::get_if<Obb>(&v)) pose.linear() = box->axes();
  if (const auto* e = std::get_if<Ellipsoid>(&v)) pose.linear() = e->axes();
  if (const auto* c = std::get_if<Cylinder>(&v)) along(c->axis());
  if (const auto* c = std::get_if<Capsule>(&v)) along(c->b() - c->a());
  return pose;
}

TEST(PairsFcl, DistancesAgree) {
  Random random(kSeed);
  for (int i = 2; i < 7; ++i) {
    for (int j = 2; j < 7; ++j) {
      for (int round = 0; round < 40; ++round) {
        const AnyVolume a = Form(random, i).volume(random.vector(1), 0.5),
                        b = Form(random, j).volume(random.vector(3), 0.5);
        fcl::CollisionObjectd first(peer_of(a), peer_pose(a)), second(peer_of(b), peer_pose(b));
        fcl::DistanceRequestd request(true);
        request.gjk_solver_type = fcl::GST_LIBCCD;
        request.distance_tolerance = 1e-9;
        fcl::DistanceResultd result;
        const double expected = std::max(0.0, fcl::distance(&first, &second, request, result));
        EXPECT_NEAR(distance(a, b), expected, 1e-6) << "kinds " << i << ' ' << j;
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
