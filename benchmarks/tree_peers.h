// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Trees over points, ours and other people's, that are asked the same questions.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::bench {

using TreeCloud = pcl::PointCloud<pcl::PointXYZ>;

/// nearest: the squared distance of the nearest point. nearest_10: of the tenth. radius: how many points are
/// nearer than that; all are listed. any: 1 if there is one, else 0.
enum class Question { nearest, nearest_10, radius, any };

std::string name_of(Question question);

class Tree {
 public:
  virtual ~Tree() = default;
  virtual double answer(Question question, const pcl::PointXYZ& place, float radius) = 0;
};

/// Somebody who builds trees; they do not outlive the cloud. `radius` is what will be asked for: cells are
/// chosen by it, where there are any.
struct TreePeer {
  std::string name;
  std::vector<Question> questions;  ///< That it has an answer for.
  std::function<std::unique_ptr<Tree>(const TreeCloud::ConstPtr& cloud, float radius)> build;
};

/// PointTree, built into the memory of the tree before it.
TreePeer our_tree(const Execution& execution);

/// "flann" (pcl::KdTreeFLANN, not sorted), "pcl-octree" (pcl::octree::OctreePointCloudSearch, cells of the
/// radius) and, where they are installed, "nanoflann" (10 points a leaf, float), "fcl-octree" (octomap's
/// cells of a fifth of the radius: a robot's usual map) and "fcl-bvh" (BVHModel<OBBRSS>, each point a
/// triangle of a hundredth of the radius: of points without triangles FCL asks nothing).
std::vector<TreePeer> tree_peers();
void add_fcl(std::vector<TreePeer>& peers);

/// Where a ray first comes as near to a point as `radius`: along it in units of its direction; infinity:
/// nowhere.
class Rays {
 public:
  virtual ~Rays() = default;
  virtual double first_hit(const float (&origin)[3], const float (&direction)[3]) = 0;
};

/// Embree's spheres (RTC_GEOMETRY_TYPE_SPHERE_POINT), one ray at a time. Only where it is installed
/// (PCL_BV_BENCH_EMBREE).
std::unique_ptr<Rays> embree_spheres(const TreeCloud& cloud, float radius);

}  // namespace pcl_bv::bench
