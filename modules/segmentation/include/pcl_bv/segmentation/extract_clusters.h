// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Euclidean clusters as a PCL class, a drop-in replacement of pcl::EuclideanClusterExtraction.
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <pcl/impl/pcl_base.hpp>
#include <stdexcept>
#include <vector>

#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/clusters.h"

namespace pcl::search {
template <typename PointT>
class Search;
}  // namespace pcl::search

namespace [[gnu::visibility("default")]] pcl_bv {

/// Drop-in replacement of pcl::EuclideanClusterExtraction, with the same setters, defaults and partition (see
/// EuclideanClusterer). Takes any point type whose x, y, z are consecutive floats or doubles. Needs no
/// explicit instantiation.
///
/// Differences from PCL:
/// - Points that are not valid (is_valid()) are ignored. In PCL, points that are not finite are undefined
///   behaviour.
/// - Clusters of equal size are in the order of their smallest index.
/// - extract() replaces the vector's contents. In PCL it appends.
/// - No search tree is needed or used.
/// - Errors are exceptions.
template <typename PointT>
class EuclideanClusterExtraction : public pcl::PCLBase<PointT> {
 public:
  using PointCloud = pcl::PointCloud<PointT>;
  using PointCloudPtr = typename PointCloud::Ptr;
  using PointCloudConstPtr = typename PointCloud::ConstPtr;
  using KdTree = pcl::search::Search<PointT>;
  using KdTreePtr = std::shared_ptr<KdTree>;

  /// Restricts the clusters to the points with these indices. In each overload a null pointer removes the
  /// restriction. (PCL's base class dereferences some null pointers.)
  void setIndices(const pcl::IndicesPtr& indices) override { indices_ = indices; }
  void setIndices(const pcl::IndicesConstPtr& indices) override {
    indices_ = indices ? pcl::make_shared<pcl::Indices>(*indices) : nullptr;
  }
  void setIndices(const pcl::PointIndicesConstPtr& indices) override {
    indices_ = indices ? pcl::make_shared<pcl::Indices>(indices->indices) : nullptr;
  }
  void setIndices(std::nullptr_t) { indices_.reset(); }
  using pcl::PCLBase<PointT>::setIndices;

  /// Stores the search tree for getSearchMethod(), so that code written for PCL compiles. extract() ignores
  /// the tree.
  void setSearchMethod(const KdTreePtr& tree) { tree_ = tree; }
  KdTreePtr getSearchMethod() const { return tree_; }

  /// Sets the tolerance. Points nearer to each other than the tolerance are linked. The tolerance is in the
  /// unit of the points and is converted to float as in PCL.
  void setClusterTolerance(double tolerance) { tolerance_ = tolerance; }
  double getClusterTolerance() const { return tolerance_; }

  /// Sets the smallest size. Clusters with fewer points are dropped. Default 1.
  void setMinClusterSize(pcl::uindex_t size) { min_size_ = size; }
  pcl::uindex_t getMinClusterSize() const { return min_size_; }

  /// Sets the largest size. Clusters with more points are treated as setOversized() says. By default there is
  /// no limit.
  void setMaxClusterSize(pcl::uindex_t size) { max_size_ = size; }
  pcl::uindex_t getMaxClusterSize() const { return max_size_; }

  /// Sets the number of points of DBSCAN's core condition (ClusterOptions::min_points). With the default of
  /// 1 every point is a core point.
  void setMinPoints(pcl::uindex_t points) { min_points_ = points; }
  pcl::uindex_t getMinPoints() const { return min_points_; }

  /// Sets the growth of the tolerance with the distance from the origin
  /// (ClusterOptions::tolerance_per_metre). Default 0.
  void setToleranceGrowth(double per_metre) { per_metre_ = per_metre; }
  double getToleranceGrowth() const { return per_metre_; }

  /// Sets the treatment of clusters above the largest size. The default is Oversized::drop.
  void setOversized(Oversized rule) { oversized_ = rule; }
  Oversized getOversized() const { return oversized_; }

  /// Sets the number of threads of extract(). 0 means all processors. The default of 1 means the calling
  /// thread. The number never changes the result.
  void setNumberOfThreads(unsigned threads) { execution_ = Threads{threads}; }

  /// Replaces `clusters` by the clusters of the input cloud. If indices are set, only the points with these
  /// indices are clustered. The largest clusters are first. The indices of each cluster are ascending. Each
  /// cluster has the header of the cloud. Without valid points there are no clusters.
  ///
  /// Throws std::logic_error without an input cloud and std::out_of_range for an index outside of the cloud.
  /// Throws std::invalid_argument in these cases:
  /// - The tolerance, as a float, is not finite or not above 0.
  /// - The smallest size exceeds the largest size.
  /// - The number of setMinPoints() is 0.
  /// - The growth is not finite or is below 0.
  /// - The growth is above 0, and the number of setMinPoints() is above 1.
  void extract(std::vector<pcl::PointIndices>& clusters) {
    const ClusterOptions options{static_cast<float>(tolerance_), min_size_, max_size_, min_points_,
                                 static_cast<float>(per_metre_), oversized_};
    clusterer_.extract(view(), options, found_, execution_);
    clusters.resize(found_.size());
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      clusters[i].header = input_->header;
      clusters[i].indices.assign(found_.list(i), found_.list(i) + found_.list_size(i));
    }
  }

 private:
  PointView view() const {
    static_assert(sizeof(pcl::index_t) == sizeof(std::int32_t),
                  "PCL is built with an index type other than 32-bit integers");
    if (!input_) throw std::logic_error("EuclideanClusterExtraction: call setInputCloud() before extract()");
    const PointView cloud = view_records(input_->points.data(), input_->size());
    return indices_ ? cloud.subset(indices_->data(), indices_->size()) : cloud;
  }

  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;

  KdTreePtr tree_;
  double tolerance_ = 0;
  pcl::uindex_t min_size_ = 1;
  pcl::uindex_t max_size_ = std::numeric_limits<pcl::uindex_t>::max();
  pcl::uindex_t min_points_ = 1;
  double per_metre_ = 0;
  Oversized oversized_ = Oversized::drop;
  Execution execution_;
  EuclideanClusterer clusterer_;
  Clusters found_;
};

}  // namespace pcl_bv
