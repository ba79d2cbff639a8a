// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// PointTree where PCL's algorithms take a pcl::search::KdTree.
#pragma once

#include <pcl/search/search.h>
// Without the implementation, own point types do not link (PCL instantiates Search for its own types only).
#include <pcl/search/impl/search.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "pcl_bv/estimation/point_cloud_view.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/trees/point_tree.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Drop-in for pcl::search::KdTree: give it to setSearchMethod(), or ask it. PointT is any type with x, y, z
/// of float or double in a row; it needs no instantiation.
///
/// Answers are those of pcl::search::KdTree: squared distances; indices of the cloud, also where
/// setInputCloud() was given a list; neighbours strictly nearer than the radius; points that are not finite
/// are in no answer, whatever is_dense says. Where it differs:
/// - Distances are compared in double and rounded once, to float; PCL computes them in float, up to 4e-7
///   off. So a point that far from the radius, or two whose distances differ by less, may be decided
///   otherwise. Clouds whose squares float does not hold (1e-23, 1e20) get their neighbours; distances beyond
///   float are infinity.
/// - Of equally near points that with the smaller index comes first, and is kept if not all are: so a sorted
///   tree is also good for pcl::EuclideanClusterExtraction, which takes the first answer for the point asked
///   about.
/// - What PCL asserts against has no neighbours: a place that is not finite, an index outside, a radius that
///   is not above 0, less than one neighbour wanted, no cloud.
///
/// A question takes the memory of its answer only, which its thread keeps for the next one. Const calls may
/// run side by side.
template <typename PointT>
class PointTreeSearch : public pcl::search::Search<PointT> {
 public:
  using Base = pcl::search::Search<PointT>;
  using PointCloud = typename Base::PointCloud;
  using PointCloudConstPtr = typename Base::PointCloudConstPtr;
  using IndicesConstPtr = typename Base::IndicesConstPtr;
  using Ptr = pcl::shared_ptr<PointTreeSearch>;
  using ConstPtr = pcl::shared_ptr<const PointTreeSearch>;
  using Base::nearestKSearch;
  using Base::radiusSearch;

  /// `sorted`: whether radiusSearch() gives the nearest first, as PCL's tree does by default. Clusters are
  /// found sooner without. nearestKSearch() always does, and radiusSearch() where it is told how many.
  explicit PointTreeSearch(bool sorted = true) : Base("PointTree", sorted) {}

  /// Threads for setInputCloud(): 0 means all processors, 1 (the default) the calling thread. Never changes
  /// an answer.
  void setNumberOfThreads(unsigned threads) { execution_.parallel = Threads{threads}; }

  /// The instruction set, an Isa, from the next setInputCloud() on: Isa::automatic as this object is made,
  /// which asks PCL_BV_ISA. Never changes an answer. Throws std::invalid_argument, as the constructor does,
  /// if this build or machine does not have it.
  void setInstructionSet(UsableIsa isa) { execution_.isa = isa; }

  /// Builds the tree of the cloud's points, or of those that the indices name: a copy, so that the cloud,
  /// which is kept for questions by index, may change. Null or without valid points: nothing has neighbours.
  /// O(n). Throws std::out_of_range for an index outside the cloud, and then nothing is changed.
  void setInputCloud(const PointCloudConstPtr& cloud,
                     const IndicesConstPtr& indices = IndicesConstPtr()) override {
    tree_.assign(!cloud    ? PointView()
                 : indices ? point_view(*cloud, *indices)
                           : point_view(*cloud),
                 execution_);
    this->input_ = cloud;
    this->indices_ = indices;
  }

  /// For the questions that PCL does not have.
  const PointTree& getPointTree() const { return tree_; }

  /// The k nearest points, ascending, or all if there are fewer: how many there are. Replaces what the
  /// vectors hold.
  int nearestKSearch(const PointT& point, int k, pcl::Indices& k_indices,
                     std::vector<float>& k_sqr_distances) const override {
    const FloatEnvironment environment;
    std::vector<Neighbor>& found = room();
    if (k > 0) tree_.nearest(place(point), static_cast<std::size_t>(k), found);
    return answer(found, k_indices, k_sqr_distances);
  }

  int nearestKSearch(const PointCloud& cloud, pcl::index_t index, int k, pcl::Indices& k_indices,
                     std::vector<float>& k_sqr_distances) const override {
    const PointT* const point = find(cloud, index);
    return point != nullptr ? nearestKSearch(*point, k, k_indices, k_sqr_distances)
                            : answer({}, k_indices, k_sqr_distances);
  }

  int nearestKSearch(pcl::index_t index, int k, pcl::Indices& k_indices,
                     std::vector<float>& k_sqr_distances) const override {
    const PointT* const point = find(index);
    return point != nullptr ? nearestKSearch(*point, k, k_indices, k_sqr_distances)
                            : answer({}, k_indices, k_sqr_distances);
  }

  /// All points nearer than the radius or, if max_nn is not 0, the max_nn nearest of them: how many there
  /// are. Replaces what the vectors hold.
  int radiusSearch(const PointT& point, double radius, pcl::Indices& k_indices,
                   std::vector<float>& k_sqr_distances, unsigned int max_nn = 0) const override {
    const FloatEnvironment environment;
    std::vector<Neighbor>& found = room();
    if (radius > 0) {
      const bool all = max_nn == 0 || max_nn >= tree_.size();
      if (all)
        tree_.near(place(point), radius, found);
      else
        tree_.nearest(place(point), max_nn, found, radius);
      const double limit = radius * radius;  // as the tree rounds it; it gives those on the sphere, too
      found.erase(std::remove_if(found.begin(), found.end(),
                                 [limit](const Neighbor& one) { return !(one.squared_distance < limit); }),
                  found.end());
      if (all && this->sorted_results_) std::sort(found.begin(), found.end());
    }
    return answer(found, k_indices, k_sqr_distances);
  }

  int radiusSearch(const PointCloud& cloud, pcl::index_t index, double radius, pcl::Indices& k_indices,
                   std::vector<float>& k_sqr_distances, unsigned int max_nn = 0) const override {
    const PointT* const point = find(cloud, index);
    return point != nullptr ? radiusSearch(*point, radius, k_indices, k_sqr_distances, max_nn)
                            : answer({}, k_indices, k_sqr_distances);
  }

  int radiusSearch(pcl::index_t index, double radius, pcl::Indices& k_indices,
                   std::vector<float>& k_sqr_distances, unsigned int max_nn = 0) const override {
    const PointT* const point = find(index);
    return point != nullptr ? radiusSearch(*point, radius, k_indices, k_sqr_distances, max_nn)
                            : answer({}, k_indices, k_sqr_distances);
  }

 private:
  // Allocating for every question would take as long as a short one does.
  static std::vector<Neighbor>& room() {
    static thread_local std::vector<Neighbor> found;
    found.clear();
    return found;
  }

  static Eigen::Vector3d place(const PointT& point) { return {point.x, point.y, point.z}; }

  static const PointT* find(const PointCloud& cloud, pcl::index_t index) {
    const auto i = static_cast<std::size_t>(index);
    return index >= 0 && i < cloud.size() ? &cloud.points[i] : nullptr;
  }

  // As PCL counts: with a list of indices, the place in that list.
  const PointT* find(pcl::index_t index) const {
    if (!this->input_) return nullptr;
    if (!this->indices_) return find(*this->input_, index);
    const auto i = static_cast<std::size_t>(index);
    return index >= 0 && i < this->indices_->size() ? find(*this->input_, (*this->indices_)[i]) : nullptr;
  }

  static int answer(const std::vector<Neighbor>& found, pcl::Indices& indices,
                    std::vector<float>& sqr_distances) {
    indices.resize(found.size());
    sqr_distances.resize(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      indices[i] = found[i].index;
      sqr_distances[i] = static_cast<float>(found[i].squared_distance);
    }
    return static_cast<int>(found.size());
  }

  PointTree tree_;
  Execution execution_;
};

}  // namespace pcl_bv
