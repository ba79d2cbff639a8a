// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/point_tree.h"

#include <gtest/gtest.h>

#include "clouds.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;

TEST(Batches, AnswerEachQuestionAsIfItWereTheOnlyOne) {
  const auto cloud = test::gaussian<float>(20'000, 6), places = test::gaussian<float>(3000, 7, 1.5);
  const PointTree tree(cloud.view());
  for (const ParallelPolicy& policy : {ParallelPolicy(Serial{}), ParallelPolicy(Threads{3})}) {
    std::vector<Neighbor> one, found;
    NeighborLists few, all;
    nearest(tree, places.view(), found, 0.1, {policy});
    nearest(tree, places.view(), 7, few, 0.5, {policy});
    near(tree, places.view(), 0.2, all, {policy});
    ASSERT_EQ(found.size(), places.size());
    std::vector<Sphere> spheres;
    std::vector<AnyVolume> boxes;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Coordinates c = load_point(places.view(), i);
      const Vector3d place(c.x, c.y, c.z);
      spheres.emplace_back(place, 0.05);
      boxes.emplace_back(Aabb(place, place + Vector3d::Constant(0.1)));
      const auto nearest_one = tree.nearest(place, 0.1);
      EXPECT_EQ(found[i].index, nearest_one ? nearest_one->index : -1);
      tree.nearest(place, 7, one, 0.5);
      ASSERT_EQ(few.first[i + 1] - few.first[i], one.size());
      for (std::size_t k = 0; k < one.size(); ++k)
        EXPECT_EQ(few.neighbors[few.first[i] + k].index, one[k].index);
      tree.near(place, 0.2, one);
      std::sort(one.begin(), one.end());
      ASSERT_EQ(all.first[i + 1] - all.first[i], one.size());
      for (std::size_t k = 0; k < one.size(); ++k)
        EXPECT_EQ(all.neighbors[all.first[i] + k].index, one[k].index);
    }
    std::vector<std::uint8_t> in_spheres, in_boxes;
    any_inside(tree, spheres, in_spheres, {policy});
    any_inside(tree, boxes, in_boxes, {policy});
    for (std::size_t i = 0; i < places.size(); ++i) {
      ASSERT_EQ(in_spheres[i], tree.any_inside(spheres[i]));
      ASSERT_EQ(in_boxes[i], tree.any_inside(boxes[i]));
    }
  }
  NeighborLists none;
  near(tree, PointView{}, 1, none);
  EXPECT_EQ(none.first, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace pcl_bv::detail
