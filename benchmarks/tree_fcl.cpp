// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A sphere that collides with a cloud, as motion planners ask: by FCL.

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <octomap/octomap.h>

#include "tree_peers.h"

namespace pcl_bv::bench {
namespace {

class Colliding : public Tree {
 public:
  explicit Colliding(std::shared_ptr<fcl::CollisionGeometryd> geometry) : geometry_(std::move(geometry)) {}

  double answer(Question, const pcl::PointXYZ& place, float radius) override {
    const fcl::Sphered sphere(radius);
    const fcl::Transform3d at(fcl::Translation3d(place.x, place.y, place.z));
    fcl::CollisionResultd result;
    return fcl::collide(geometry_.get(), fcl::Transform3d::Identity(), &sphere, at, fcl::CollisionRequestd(),
                        result) != 0;
  }

 private:
  std::shared_ptr<fcl::CollisionGeometryd> geometry_;
};

std::unique_ptr<Tree> fcl_octree(const TreeCloud::ConstPtr& cloud, float radius) {
  const auto map = std::make_shared<octomap::OcTree>(radius / 5);
  for (const pcl::PointXYZ& p : *cloud)
    map->updateNode(octomap::point3d(p.x, p.y, p.z), true, true);
  map->updateInnerOccupancy();
  return std::make_unique<Colliding>(std::make_shared<fcl::OcTreed>(map));
}

std::unique_ptr<Tree> fcl_bvh(const TreeCloud::ConstPtr& cloud, float radius) {
  const auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel(static_cast<int>(cloud->size()), 3 * static_cast<int>(cloud->size()));
  for (const pcl::PointXYZ& p : *cloud) {
    const fcl::Vector3d at(p.x, p.y, p.z);
    model->addTriangle(at, at + fcl::Vector3d(0.01 * radius, 0, 0), at + fcl::Vector3d(0, 0.01 * radius, 0));
  }
  model->endModel();
  return std::make_unique<Colliding>(model);
}

}  // namespace

void add_fcl(std::vector<TreePeer>& peers) {
  peers.push_back({"fcl-octree", {Question::any}, fcl_octree});
  peers.push_back({"fcl-bvh", {Question::any}, fcl_bvh});
}

}  // namespace pcl_bv::bench
