// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "pcl_bv/estimation/bounding_volume_estimation.h"
#include "pcl_bv/estimation/point_cloud_view.h"
#include "pcl_bv/fitting/batch.h"

namespace pcl_bv {

template <typename PointT, typename VolumeT>
void BoundingVolumeEstimation<PointT, VolumeT>::setIndices(std::nullptr_t) {
  this->indices_.reset();
}

// PCLBase remembers that indices were set, but not that they were taken away again: null means the whole
// cloud here.
template <typename PointT, typename VolumeT>
void BoundingVolumeEstimation<PointT, VolumeT>::setIndices(const pcl::IndicesPtr& indices) {
  this->indices_ = indices;
}

template <typename PointT, typename VolumeT>
void BoundingVolumeEstimation<PointT, VolumeT>::setIndices(const pcl::IndicesConstPtr& indices) {
  this->indices_ = indices ? pcl::make_shared<pcl::Indices>(*indices) : nullptr;
}

template <typename PointT, typename VolumeT>
void BoundingVolumeEstimation<PointT, VolumeT>::setIndices(const pcl::PointIndicesConstPtr& indices) {
  this->indices_ = indices ? pcl::make_shared<pcl::Indices>(indices->indices) : nullptr;
}

template <typename PointT, typename VolumeT>
auto BoundingVolumeEstimation<PointT, VolumeT>::cloud() const -> const PointCloud& {
  if (!this->input_) throw std::logic_error("BoundingVolumeEstimation: compute() before setInputCloud()");
  return *this->input_;
}

template <typename PointT, typename VolumeT>
PointView BoundingVolumeEstimation<PointT, VolumeT>::input() const {
  return this->indices_ ? point_view(cloud(), *this->indices_) : point_view(cloud());
}

template <typename PointT, typename VolumeT>
EstimationResult BoundingVolumeEstimation<PointT, VolumeT>::compute(VolumeT& volume) const {
  return fit(input(), volume, execution_);
}

template <typename PointT, typename VolumeT>
std::vector<EstimationResult> BoundingVolumeEstimation<PointT, VolumeT>::compute(
    const std::vector<pcl::PointIndices>& clusters, std::vector<VolumeT>& volumes) const {
  std::vector<PointView> views;
  views.reserve(clusters.size());
  for (const pcl::PointIndices& cluster : clusters)
    views.push_back(point_view(cloud(), cluster.indices));
  volumes.assign(clusters.size(), VolumeT());
  std::vector<EstimationResult> results(clusters.size());
  for_each_view(views, execution_, [&](std::size_t c, const Execution& execution) {
    results[c] = fit(views[c], volumes[c], execution);
  });
  return results;
}

template <typename PointT, int K>
const std::shared_ptr<const KdopSet>& KdopEstimation<PointT, K>::of_k() {
  return K == 6    ? KdopSet::dop6()
         : K == 14 ? KdopSet::dop14()
         : K == 18 ? KdopSet::dop18()
                   : KdopSet::dop26();
}

template <typename PointT, int K>
void KdopEstimation<PointT, K>::setDirections(std::shared_ptr<const KdopSet> directions) {
  if (!directions) throw std::invalid_argument("KdopEstimation::setDirections: a null pointer");
  directions_ = std::move(directions);
}

template <typename PointT>
EstimationResult SphereEstimation<PointT>::compute(Sphere& sphere, SphereCertificate& certificate) const {
  if (options_.method != SphereMethod::exact)
    throw std::invalid_argument("SphereEstimation: only the method exact has a certificate");
  return fit_smallest_sphere(this->input(), sphere, certificate, this->execution());
}

template <typename PointT>
void BestEstimation<PointT>::setMethods(const std::vector<std::string>& names) {
  std::vector<const Method*> among;
  for (const std::string& name : names) {
    among.push_back(find_method(name));
    if (among.back() == nullptr || among.back()->name == "best") {
      throw std::invalid_argument("BestEstimation::setMethods: '" + name + "' is no method to choose from");
    }
  }
  if (among.empty()) throw std::invalid_argument("BestEstimation::setMethods: no names");
  among_ = std::move(among);
}

}  // namespace pcl_bv
