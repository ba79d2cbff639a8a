// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// PointTree as a search method for PCL's algorithms, in place of pcl::search::KdTree.
#pragma once

#include <pcl/search/search.h>
// Without this implementation, user-defined point types do not link, because PCL instantiates Search only for
// its own point types.
#include <pcl/search/impl/search.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/trees/point_tree.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Drop-in replacement for pcl::search::KdTree: pass it to setSearchMethod(), or query it directly. PointT is
/// any type with consecutive members x, y, z of type float or double. No explicit instantiation is needed.
///
/// The results are those of pcl::search::KdTree:
///
/// - Distances are squared.
/// - Indices are indices of the cloud, even if setInputCloud() was given an index list.
/// - radiusSearch() returns points that are strictly nearer than the radius.
/// - Points that are not finite are never returned, regardless of is_dense.
///
/// Differences from pcl::search::KdTree:
///
/// - Distances are compared in double. Only the returned values are rounded to float. PCL computes distances
///   in float, with a relative error of up to 4e-7. The two searches may therefore differ in whether they
///   return a point at almost exactly the radius. They may also differ in the order of two points at almost
///   the same distance.
/// - Neighbours are also found in clouds whose squared distances are outside the range of float (coordinates
///   of 1e-23 or 1e20). A distance above this range is returned as infinity.
/// - Equally near points are ordered by index. If the number of neighbours is limited, the points with the
///   smaller indices are returned. A sorted tree also works with pcl::EuclideanClusterExtraction. That class
///   assumes that the first neighbour is the query point itself and skips this neighbour. If several points
///   have the same position, the skipped point is always in the cluster already.
/// - The result is empty where PCL has an assertion: for a query point that is not finite, an index out of
///   range, a radius that is not above 0, a k below 1, or a search without a cloud.
///
/// A query allocates only the buffer of its result. The thread reuses this buffer for its next query. Const
/// member functions may run concurrently.
template <typename PointT>
class PointTreeSearch : public pcl::search::Search<PointT> {
 public:
  using Base = pcl::search::Search<PointT>;
  using PointCloud = typename Base::PointCloud;
  using PointCloudConstPtr = typename Base::PointCloudConstPtr;
  using IndicesConstPtr = typename Base::IndicesConstPtr;
  using Ptr = pcl::shared_ptr<PointTreeSearch>;
  using ConstPtr = pcl::shared_ptr<const PointTreeSearch>;
  /// What setInputCloud() returns: bool since PCL 1.15, before that void.
  using SetInputResult = decltype(std::declval<Base&>().setInputCloud(
      std::declval<const PointCloudConstPtr&>(), std::declval<const IndicesConstPtr&>()));
  using Base::nearestKSearch;
  using Base::radiusSearch;

  /// Creates a search without a cloud. `sorted` is whether radiusSearch() sorts its result by distance, as
  /// PCL's tree does by default. Clustering is faster with `false`. nearestKSearch() always sorts its result.
  /// radiusSearch() also sorts if max_nn is not 0 and less than the number of points.
  explicit PointTreeSearch(bool sorted = true) : Base("PointTree", sorted) {}

  /// Sets the number of threads of setInputCloud(): 0 means all processors, 1 (the default) the calling
  /// thread. Never changes a result.
  void setNumberOfThreads(unsigned threads) { execution_.parallel = Threads{threads}; }

  /// Sets the instruction set (Isa). Takes effect at the next setInputCloud(). The default, Isa::automatic,
  /// reads PCL_BV_ISA when this object is constructed. Never changes a result. Throws std::invalid_argument,
  /// as the constructor does, if this build or this machine does not support the instruction set.
  void setInstructionSet(UsableIsa isa) { execution_.isa = isa; }

  /// Builds the tree of the cloud's valid points, or of those at `indices`. The tree holds a copy of the
  /// points, so the cloud may change afterwards. The search also stores `cloud` and `indices`, because
  /// queries by index read the query point from the cloud. If the cloud is null or has no valid point, all
  /// results are empty. O(n log n). Throws std::out_of_range for an index outside the cloud, and then changes
  /// nothing. Returns true where PCL's method has a result.
  SetInputResult setInputCloud(const PointCloudConstPtr& cloud,
                               const IndicesConstPtr& indices = IndicesConstPtr()) override {
    tree_.assign(!cloud    ? PointView()
                 : indices ? point_view(*cloud, *indices)
                           : point_view(*cloud),
                 execution_);
    this->input_ = cloud;
    this->indices_ = indices;
    return static_cast<SetInputResult>(true);
  }

  /// Returns the tree, for queries that PCL's interface does not have.
  const PointTree& getPointTree() const { return tree_; }

  /// Finds the k nearest points, or all points if there are fewer, in ascending order of distance. Returns
  /// their number. Overwrites the vectors.
  int nearestKSearch(const PointT& point, int k, pcl::Indices& k_indices,
                     std::vector<float>& k_sqr_distances) const override {
    const FloatEnvironment environment;
    std::vector<Neighbor>& found = result_buffer();
    if (k > 0) tree_.nearest(point_vector(point), static_cast<std::size_t>(k), found);
    return copy_result(found, k_indices, k_sqr_distances);
  }

  int nearestKSearch(const PointCloud& cloud, pcl::index_t index, int k, pcl::Indices& k_indices,
                     std::vector<float>& k_sqr_distances) const override {
    const PointT* const point = point_at(cloud, index);
    return point != nullptr ? nearestKSearch(*point, k, k_indices, k_sqr_distances)
                            : copy_result({}, k_indices, k_sqr_distances);
  }

  int nearestKSearch(pcl::index_t index, int k, pcl::Indices& k_indices,
                     std::vector<float>& k_sqr_distances) const override {
    const PointT* const point = point_at(index);
    return point != nullptr ? nearestKSearch(*point, k, k_indices, k_sqr_distances)
                            : copy_result({}, k_indices, k_sqr_distances);
  }

  /// Finds all points nearer than the radius or, if max_nn is not 0, the max_nn nearest of them. Returns
  /// their number. Overwrites the vectors.
  int radiusSearch(const PointT& point, double radius, pcl::Indices& k_indices,
                   std::vector<float>& k_sqr_distances, unsigned int max_nn = 0) const override {
    const FloatEnvironment environment;
    std::vector<Neighbor>& found = result_buffer();
    if (radius > 0) {
      const bool all = max_nn == 0 || max_nn >= tree_.size();
      if (all)
        tree_.near(point_vector(point), radius, found);
      else
        tree_.nearest(point_vector(point), max_nn, found, radius);
      const double limit = radius * radius;  // rounded as in PointTree::near()
      // The tree also returns points at exactly this distance.
      found.erase(std::remove_if(found.begin(), found.end(),
                                 [limit](const Neighbor& one) { return !(one.squared_distance < limit); }),
                  found.end());
      if (all && this->sorted_results_) std::sort(found.begin(), found.end());
    }
    return copy_result(found, k_indices, k_sqr_distances);
  }

  int radiusSearch(const PointCloud& cloud, pcl::index_t index, double radius, pcl::Indices& k_indices,
                   std::vector<float>& k_sqr_distances, unsigned int max_nn = 0) const override {
    const PointT* const point = point_at(cloud, index);
    return point != nullptr ? radiusSearch(*point, radius, k_indices, k_sqr_distances, max_nn)
                            : copy_result({}, k_indices, k_sqr_distances);
  }

  int radiusSearch(pcl::index_t index, double radius, pcl::Indices& k_indices,
                   std::vector<float>& k_sqr_distances, unsigned int max_nn = 0) const override {
    const PointT* const point = point_at(index);
    return point != nullptr ? radiusSearch(*point, radius, k_indices, k_sqr_distances, max_nn)
                            : copy_result({}, k_indices, k_sqr_distances);
  }

 private:
  // Returns an empty buffer that the thread reuses, because allocating a buffer takes as long as a short
  // query.
  static std::vector<Neighbor>& result_buffer() {
    static thread_local std::vector<Neighbor> found;
    found.clear();
    return found;
  }

  static Eigen::Vector3d point_vector(const PointT& point) { return {point.x, point.y, point.z}; }

  static const PointT* point_at(const PointCloud& cloud, pcl::index_t index) {
    const auto i = static_cast<std::size_t>(index);
    return index >= 0 && i < cloud.size() ? &cloud.points[i] : nullptr;
  }

  // As in PCL, `index` is a position in the index list if setInputCloud() was given one.
  const PointT* point_at(pcl::index_t index) const {
    if (!this->input_) return nullptr;
    if (!this->indices_) return point_at(*this->input_, index);
    const auto i = static_cast<std::size_t>(index);
    return index >= 0 && i < this->indices_->size() ? point_at(*this->input_, (*this->indices_)[i]) : nullptr;
  }

  static int copy_result(const std::vector<Neighbor>& found, pcl::Indices& indices,
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
