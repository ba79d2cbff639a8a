// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The clusterer as a PCL class: change the namespace, get the same clusters sooner.
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

#include "pcl_bv/points/point_records.h"
#include "pcl_bv/segmentation/euclidean_clusters.h"

namespace pcl::search {
template <typename PointT>
class Search;
}  // namespace pcl::search

namespace [[gnu::visibility("default")]] pcl_bv {

/// Drop-in for pcl::EuclideanClusterExtraction: the same partition (see EuclideanClusterer), the same setters
/// and defaults. Any point type with x, y, z of float or double in a row works, without instantiation.
///
/// Different from PCL: points that are not finite are skipped, instead of being undefined behaviour; clusters
/// of equal size come in the order of their smallest index; the result replaces what the vector held, where
/// PCL appends; no search tree is needed or used; errors are exceptions.
template <typename PointT>
class EuclideanClusterExtraction : public pcl::PCLBase<PointT> {
 public:
  using PointCloud = pcl::PointCloud<PointT>;
  using PointCloudPtr = typename PointCloud::Ptr;
  using PointCloudConstPtr = typename PointCloud::ConstPtr;
  using KdTree = pcl::search::Search<PointT>;
  using KdTreePtr = std::shared_ptr<KdTree>;

  /// Restricts the clusters to some points, or, with a null pointer of any kind, lifts the restriction (PCL's
  /// base class dereferences some of these).
  void setIndices(const pcl::IndicesPtr& indices) override { indices_ = indices; }
  void setIndices(const pcl::IndicesConstPtr& indices) override {
    indices_ = indices ? pcl::make_shared<pcl::Indices>(*indices) : nullptr;
  }
  void setIndices(const pcl::PointIndicesConstPtr& indices) override {
    indices_ = indices ? pcl::make_shared<pcl::Indices>(indices->indices) : nullptr;
  }
  void setIndices(std::nullptr_t) { indices_.reset(); }
  using pcl::PCLBase<PointT>::setIndices;

  /// Kept for getSearchMethod(), so that code written for PCL compiles; never used.
  void setSearchMethod(const KdTreePtr& tree) { tree_ = tree; }
  KdTreePtr getSearchMethod() const { return tree_; }

  /// Points nearer to each other than this belong together; unit of the points, used as float like PCL does.
  void setClusterTolerance(double tolerance) { tolerance_ = tolerance; }
  double getClusterTolerance() const { return tolerance_; }

  /// Clusters of fewer points are dropped. Default 1.
  void setMinClusterSize(pcl::uindex_t size) { min_size_ = size; }
  pcl::uindex_t getMinClusterSize() const { return min_size_; }

  /// Clusters of more points are dropped. Default: no limit.
  void setMaxClusterSize(pcl::uindex_t size) { max_size_ = size; }
  pcl::uindex_t getMaxClusterSize() const { return max_size_; }

  /// DBSCAN (Ester et al. 1996) with more than 1: points are core that have so many, themselves included, nearer
  /// than the tolerance; linked core points are a cluster, with the points nearest to them, and the rest is
  /// noise. Default 1: every point is core.
  void setMinPoints(pcl::uindex_t points) { min_points_ = points; }
  pcl::uindex_t getMinPoints() const { return min_points_; }

  /// By how much the tolerance grows with the distance from the origin (ClusterSettings::tolerance_per_metre).
  /// Default 0: not at all.
  void setToleranceGrowth(double per_metre) { per_metre_ = per_metre; }
  double getToleranceGrowth() const { return per_metre_; }

  /// What becomes of clusters above the maximum size (Oversized). Default: they are dropped.
  void setOversized(Oversized rule) { oversized_ = rule; }
  Oversized getOversized() const { return oversized_; }

  /// Threads for extract(): 0 means all processors, 1 (the default) the calling thread. Never changes the
  /// result.
  void setNumberOfThreads(unsigned threads) { policy_ = Threads{threads}; }

  /// Replaces `clusters` with those of the input cloud, or of its points in setIndices() (null: the whole
  /// cloud): largest first, indices ascending, each with the cloud's header. No finite point: no clusters.
  ///
  /// Throws std::logic_error without an input cloud, std::out_of_range for an index outside it,
  /// std::invalid_argument if the tolerance is not finite and > 0 as a float, the minimum size exceeds the
  /// maximum, or the growth is not finite and >= 0, or not 0 with more than one minimum point.
  void extract(std::vector<pcl::PointIndices>& clusters) {
    const ClusterSettings settings{static_cast<float>(tolerance_), min_size_,
                                   max_size_, min_points_,
                                   static_cast<float>(per_metre_), oversized_};
    clusterer_.extract(view(), settings, found_, policy_);
    clusters.resize(found_.size());
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      clusters[i].header = input_->header;
      clusters[i].indices.assign(found_.cluster(i), found_.cluster(i) + found_.cluster_size(i));
    }
  }

 private:
  PointView view() const {
    static_assert(sizeof(pcl::index_t) == sizeof(std::int32_t), "PCL is built with another index type");
    if (!input_) throw std::logic_error("EuclideanClusterExtraction: extract() before setInputCloud()");
    const PointView cloud = view_records(input_->points.data(), input_->size());
    return indices_ ? select_points(cloud, indices_->data(), indices_->size()) : cloud;
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
  ParallelPolicy policy_ = Serial{};
  EuclideanClusterer clusterer_;
  Clusters found_;
};

}  // namespace pcl_bv
