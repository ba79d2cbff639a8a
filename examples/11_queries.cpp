// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Makes five queries of one sweep: the nearest point, the points in view, a collision along a path, the hit
// of a ray and the contact of a robot arm.
#include <pcl_bv/trees/collision.h>
#include <pcl_bv/trees/point_tree.h>
#include <pcl_bv/volumes/hull.h>

#include <iostream>
#include <vector>

int main() {
  std::vector<float> xyz;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j)  // a wall 5 m ahead (x), 4 m wide (y) and 3 m high (z)
      xyz.insert(xyz.end(), {5, 0.04F * static_cast<float>(i) - 2, 0.03F * static_cast<float>(j)});
  }
  const auto cloud = pcl_bv::PointView::of(xyz.data(), 3 * sizeof(float), xyz.size() / 3);

  pcl_bv::PointTree tree(cloud);  // 10 000 points: 0.2 to 0.4 ms
  const auto nearest = tree.nearest({0, 0, 1});
  std::vector<std::int32_t> seen;
  tree.all_inside(pcl_bv::frustum(Eigen::Isometry3d(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY())),
                                  0.1, 20, 0.1, 0.1),
                  seen);
  std::cout << "nearest point " << nearest->index << ", " << seen.size() << " points in view\n";

  // Two paths, 4 m and 6 m long, as capsules with the radius of the robot. The longer path hits the wall.
  const bool short_path = tree.any_inside(pcl_bv::Capsule({0, 0, 1}, {4, 0, 1}, 0.5));
  const bool long_path = tree.any_inside(pcl_bv::Capsule({0, 0, 1}, {6, 0, 1}, 0.5));
  const auto hit = tree.first_hit({0, 0, 1}, {1, 0, 0}, 0.05);

  // An arm of two links is tested twice: where its volumes are defined, and 4.08 m ahead (x).
  const pcl_bv::MovingVolumes arm(
      {pcl_bv::Capsule({0, 0, 1}, {0.5, 0, 1}, 0.1), pcl_bv::Aabb({0.5, -0.1, 0.9}, {0.9, 0.1, 1.1})});
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const bool here = pcl_bv::within(tree, arm, pose, 0.05);
  pose.translation().x() = 4.08;
  std::vector<std::int32_t> touching;
  pcl_bv::list_within(tree, arm, pose, 0.05, touching);
  std::cout << "the ray hits at " << hit->t << " m; " << touching.size() << " link touches the wall\n";

  const bool right = !seen.empty() && !short_path && long_path && hit->t > 4.9 && hit->t < 5 && !here &&
                     touching == std::vector<std::int32_t>{1};
  return right ? 0 : 1;
}
