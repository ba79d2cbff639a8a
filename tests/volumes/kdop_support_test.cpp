// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of how far a k-DOP reaches: its support, its box and its image, which must hold by exact arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "exact.h"
#include "kdop_sets.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Vector3d;

TEST(KdopSupport, SupportIsTheFarthestCorner) {
  Random random(35);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
      const Kdop kdop = around(Kdop(set), random.cloud(scale, Span::solid, 12));
      const auto corners = kdop.corners();
      for (int i = 0; i < 30; ++i) {
        const Vector3d d = i < 6 ? Vector3d((i % 2 ? 1 : -1) * Vector3d::Unit(i / 2)) : random.vector(1);
        const Vector3d s = kdop.support(d);
        double best = -std::numeric_limits<double>::infinity();
        for (const Vector3d& c : corners)
          best = std::max(best, d.dot(c - corners[0]));
        EXPECT_NEAR(d.dot(s - corners[0]), best, 1e-13 * scale.extent + 1e-9 * (scale.offset > 0));
        EXPECT_LE(kdop.distance(s), 1e-13 * scale.extent + 2e-9 * (scale.offset > 0));
      }
    }
  }
}

TEST(KdopSupport, AabbHoldsThePolytope) {
  Random random(36);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
      const auto points = random.cloud(scale, Span::solid, 12);
      const Kdop kdop = around(Kdop(set), points);
      const Aabb box = kdop.aabb();
      for (const Vector3d& p : points)
        EXPECT_TRUE(box.contains(p));
      Aabb corners;
      for (const Vector3d& c : kdop.corners())
        corners.extend(c);
      const double slack = 1e-13 * scale.extent + 1e-8 * (scale.offset > 0);
      EXPECT_LT((box.max() - corners.max()).cwiseAbs().maxCoeff(), slack + 1e-307);
      EXPECT_LT((box.min() - corners.min()).cwiseAbs().maxCoeff(), slack + 1e-307);
    }
  }
}

TEST(KdopSupport, TransformedHoldsTheExactImageTightly) {
  Random random(37);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      for (const Span span : spans()) {
        SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
        const auto points = random.cloud(scale, span, 8);
        const Kdop kdop = around(Kdop(set), points);
        const Eigen::Isometry3d t = random.isometry(scale.extent);
        const Kdop moved = kdop.transformed(t);
        for (const Vector3d& p : points)
          ASSERT_TRUE(inside(moved, image(t, exact(p))));
        Kdop corners(set);
        for (const Vector3d& c : kdop.corners())
          corners.extend(t * c);
        for (std::size_t i = 0; i < set->size(); ++i) {
          const double n = set->direction(i).norm();
          const double slack = n * (1e-13 * scale.extent + 3e-8 * (scale.offset > 0)) + 1e-300;
          EXPECT_NEAR(moved.max(i), corners.max(i), slack) << i;
          EXPECT_NEAR(moved.min(i), corners.min(i), slack) << i;
        }
      }
    }
  }
}

TEST(KdopSupport, TransformedByTheIdentityStaysWhatItIs) {
  SlabVector reach(13);
  reach << 1, 1, 1, 2.5, 2.5, 2.5, 2.5, 1.75, 1.75, 1.75, 1.75, 1.75, 1.75;
  const Kdop kdop(KdopSet::dop26(), -reach, reach);
  EXPECT_EQ(kdop.transformed(Eigen::Isometry3d::Identity()), kdop);
}

}  // namespace
}  // namespace pcl_bv::detail
