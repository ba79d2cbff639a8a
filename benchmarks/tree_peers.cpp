// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Trees that answer with neighbours.

#include "tree_peers.h"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/octree/octree_search.h>

#include <limits>

#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/trees/point_tree.h"

#ifdef PCL_BV_BENCH_NANOFLANN
#include <nanoflann.hpp>
#endif

namespace pcl_bv::bench {
using namespace detail;
namespace {

using Place = pcl::PointXYZ;

class Ours : public Tree {
 public:
  explicit Ours(const PointTree& tree) : tree_(tree) {}

  double answer(Question question, const Place& place, float radius) override {
    const Eigen::Vector3d p(place.x, place.y, place.z);
    switch (question) {
      case Question::nearest:
        return tree_.nearest(p)->squared_distance;
      case Question::nearest_10:
        tree_.nearest(p, 10, found_);
        return found_.back().squared_distance;
      case Question::radius:
        tree_.near(p, radius, found_);
        return static_cast<double>(found_.size());
      default:
        return tree_.any_near(p, radius);
    }
  }

 private:
  const PointTree& tree_;
  std::vector<Neighbor> found_;
};

// PCL's two have the same questions.
template <typename Search>
class OfPcl : public Tree {
 public:
  explicit OfPcl(Search search) : search_(std::move(search)) {}

  double answer(Question question, const Place& place, float radius) override {
    switch (question) {
      case Question::nearest:
      case Question::nearest_10:
        search_->nearestKSearch(place, question == Question::nearest ? 1 : 10, indices_, squares_);
        return squares_.back();
      case Question::radius:
        return search_->radiusSearch(place, radius, indices_, squares_);
      default:
        return search_->radiusSearch(place, radius, indices_, squares_, 1);
    }
  }

 private:
  Search search_;
  pcl::Indices indices_;
  std::vector<float> squares_;
};

std::unique_ptr<Tree> flann(const TreeCloud::ConstPtr& cloud, float) {
  auto search = std::make_unique<pcl::KdTreeFLANN<Place>>(false);
  search->setInputCloud(cloud);
  return std::make_unique<OfPcl<decltype(search)>>(std::move(search));
}

std::unique_ptr<Tree> pcl_octree(const TreeCloud::ConstPtr& cloud, float radius) {
  auto search = std::make_unique<pcl::octree::OctreePointCloudSearch<Place>>(radius);
  search->setInputCloud(cloud);
  search->addPointsFromInputCloud();
  return std::make_unique<OfPcl<decltype(search)>>(std::move(search));
}

#ifdef PCL_BV_BENCH_NANOFLANN
struct Adaptor {
  const TreeCloud& cloud;
  std::size_t kdtree_get_point_count() const { return cloud.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return cloud[i].data[axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

// Stops at the first point that is near enough.
struct FirstInside {
  using DistanceType = float;
  float limit;
  bool found = false;
  bool full() const { return found; }
  std::size_t size() const { return found; }
  float worstDist() const { return limit; }
  bool addPoint(float square, int) {
    found = found || square < limit;
    return !found;
  }
};

class Nanoflann : public Tree {
 public:
  explicit Nanoflann(const TreeCloud& cloud) : adaptor_{cloud}, tree_(3, adaptor_, {10}) {}

  double answer(Question question, const Place& place, float radius) override {
    int indices[10];
    float squares[10];
    switch (question) {
      case Question::nearest:
        tree_.knnSearch(place.data, 1, indices, squares);
        return squares[0];
      case Question::nearest_10:
        tree_.knnSearch(place.data, 10, indices, squares);
        return squares[9];
      case Question::radius:
        tree_.radiusSearch(place.data, radius * radius, near_, nanoflann::SearchParams(32, 0, false));
        return static_cast<double>(near_.size());
      default: {
        FirstInside first{radius * radius};
        tree_.findNeighbors(first, place.data, {});
        return first.found;
      }
    }
  }

 private:
  using Metric = nanoflann::L2_Simple_Adaptor<float, Adaptor>;
  Adaptor adaptor_;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Adaptor, 3, int> tree_;
  std::vector<std::pair<int, float>> near_;
};
#endif

}  // namespace

std::string name_of(Question question) {
  static const char* const names[] = {"nearest", "nearest-10", "radius", "any"};
  return names[static_cast<int>(question)];
}

TreePeer our_tree(const Execution& execution) {
  return {"ours",
          {Question::nearest, Question::nearest_10, Question::radius, Question::any},
          [execution, tree = std::make_shared<PointTree>()](const TreeCloud::ConstPtr& cloud, float) {
            tree->assign(point_view(*cloud), execution);
            return std::make_unique<Ours>(*tree);
          }};
}

std::vector<TreePeer> tree_peers() {
  const std::vector<Question> all = {Question::nearest, Question::nearest_10, Question::radius,
                                     Question::any};
  std::vector<TreePeer> peers{{"flann", all, flann}, {"pcl-octree", all, pcl_octree}};
#ifdef PCL_BV_BENCH_NANOFLANN
  peers.push_back({"nanoflann", all, [](const TreeCloud::ConstPtr& cloud, float) {
                     return std::make_unique<Nanoflann>(*cloud);
                   }});
#endif
#ifdef PCL_BV_BENCH_FCL
  add_fcl(peers);
#endif
  return peers;
}

}  // namespace pcl_bv::bench
