// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounding volumes the PCL way: set a cloud, set indices, compute.
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
// Without the implementation, own point types do not link (PCL instantiates PCLBase for its own types only).
#include <pcl/impl/pcl_base.hpp>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/estimation/point_cloud_view.h"
#include "pcl_bv/fitting/batch.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/fit_obb.h"
#include "pcl_bv/fitting/methods.h"

namespace pcl_bv {

/// Base of the estimators: holds the input, and knows how to run one fit or a batch.
///
/// \tparam PointT any point type with x, y, z of float or double, PCL's or an own one. Volumes are in the
/// unit and frame of these coordinates; the cloud's sensor pose is not applied. \tparam VolumeT the volume
/// that compute() fills.
template <typename PointT, typename VolumeT>
class BoundingVolumeEstimation : public pcl::PCLBase<PointT> {
 public:
  using Base = pcl::PCLBase<PointT>;
  using PointCloud = typename Base::PointCloud;
  using PointCloudConstPtr = typename Base::PointCloudConstPtr;
  using Ptr = pcl::shared_ptr<BoundingVolumeEstimation>;
  using ConstPtr = pcl::shared_ptr<const BoundingVolumeEstimation>;

  /// Restricts the fit to some points, or, with a null pointer, lifts the restriction. (PCLBase remembers
  /// that indices were set, but not that they were taken away again.)
  void setIndices(const pcl::IndicesPtr& indices) override { this->indices_ = indices; }
  void setIndices(const pcl::IndicesConstPtr& indices) override {
    this->indices_ = indices ? pcl::make_shared<pcl::Indices>(*indices) : nullptr;
  }
  void setIndices(const pcl::PointIndicesConstPtr& indices) override {
    this->indices_ = indices ? pcl::make_shared<pcl::Indices>(indices->indices) : nullptr;
  }
  void setIndices(std::nullptr_t) { this->indices_.reset(); }
  using Base::setIndices;

  /// Threads for compute(): 0 means all processors, 1 (the default) the calling thread. Never changes the
  /// result; clouds that are done in less than about 200 us are not threaded.
  void setNumberOfThreads(unsigned threads) { execution_.parallel = Threads{threads}; }

  /// The instruction set, an Isa: Isa::automatic as this object is made, which asks PCL_BV_ISA. Never changes
  /// the result. Throws std::invalid_argument, as the constructor does, if this build or machine does not
  /// have it.
  void setInstructionSet(UsableIsa isa) { execution_.isa = isa; }

  /// Fits the volume to the input cloud, or to those points of it that the indices name.
  ///
  /// Points with a coordinate that is not finite are dropped, whatever is_dense says. No point left: an empty
  /// volume and `no_valid_points`. A fit that fails: an empty volume, `failed` and the reason. Throws
  /// std::logic_error if no cloud was set, std::out_of_range for an index outside the cloud.
  EstimationResult compute(VolumeT& volume) const { return fit(input(), volume, execution_); }

  /// Fits one volume to each cluster (index lists into the input cloud; setIndices() does not matter here),
  /// in order. The same bits as one compute() per cluster: one that fails takes no other with it. Throws as
  /// compute() does, before anything is written.
  std::vector<EstimationResult> compute(const std::vector<pcl::PointIndices>& clusters,
                                        std::vector<VolumeT>& volumes) const {
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

 protected:
  virtual EstimationResult fit(const PointView& points, VolumeT& volume,
                               const Execution& execution) const = 0;

  /// What compute() fits: the cloud or those points of it that the indices name. Throws as compute() does.
  PointView input() const {
    return this->indices_ ? point_view(cloud(), *this->indices_) : point_view(cloud());
  }
  const Execution& execution() const { return execution_; }

 private:
  const PointCloud& cloud() const {
    if (!this->input_) throw std::logic_error("BoundingVolumeEstimation: compute() before setInputCloud()");
    return *this->input_;
  }

  Execution execution_;
};

/// The estimator of a fit without settings.
template <typename PointT, typename VolumeT,
          EstimationResult (*fit_points)(const PointView&, VolumeT&, const Execution&)>
class FitEstimation : public BoundingVolumeEstimation<PointT, VolumeT> {
 public:
  using Ptr = pcl::shared_ptr<FitEstimation>;
  using ConstPtr = pcl::shared_ptr<const FitEstimation>;

 protected:
  EstimationResult fit(const PointView& points, VolumeT& volume, const Execution& execution) const override {
    return fit_points(points, volume, execution);
  }
};

/// The axis-aligned box, the convex hull, a small cylinder, a small capsule. See fit_aabb() and so on.
template <typename PointT>
using AabbEstimation = FitEstimation<PointT, Aabb, fit_aabb>;
template <typename PointT>
using HullEstimation = FitEstimation<PointT, Hull, fit_hull>;
template <typename PointT>
using CylinderEstimation = FitEstimation<PointT, Cylinder, fit_cylinder>;
template <typename PointT>
using CapsuleEstimation = FitEstimation<PointT, Capsule, fit_capsule>;

/// The k-DOP along K / 2 directions, K = 6, 14, 18 or 26, or along your own. See fit_kdop().
template <typename PointT, int K = 26>
class KdopEstimation : public BoundingVolumeEstimation<PointT, Kdop> {
  static_assert(K == 6 || K == 14 || K == 18 || K == 26, "K is 6, 14, 18 or 26");

 public:
  using Ptr = pcl::shared_ptr<KdopEstimation>;
  using ConstPtr = pcl::shared_ptr<const KdopEstimation>;
  using BoundingVolumeEstimation<PointT, Kdop>::compute;

  /// Other directions than those of K, which are the default. Throws std::invalid_argument for a null
  /// pointer.
  void setDirections(std::shared_ptr<const KdopSet> directions) {
    if (!directions) throw std::invalid_argument("KdopEstimation::setDirections: a null pointer");
    directions_ = std::move(directions);
  }
  const std::shared_ptr<const KdopSet>& getDirections() const { return directions_; }

  /// The same, and for each slab which points of the input cloud touch it; empty if there is no valid point.
  EstimationResult compute(Kdop& kdop, SlabPoints& touching) const {
    return fit_kdop(this->input(), directions_, kdop, touching, this->execution());
  }

 protected:
  EstimationResult fit(const PointView& points, Kdop& kdop, const Execution& execution) const override {
    return fit_kdop(points, directions_, kdop, execution);
  }

 private:
  static const std::shared_ptr<const KdopSet>& of_k() {
    return K == 6    ? KdopSet::dop6()
           : K == 14 ? KdopSet::dop14()
           : K == 18 ? KdopSet::dop18()
                     : KdopSet::dop26();
  }

  std::shared_ptr<const KdopSet> directions_ = of_k();
};

/// A bounding sphere: the smallest one unless another method is set. See fit_sphere().
template <typename PointT>
class SphereEstimation : public BoundingVolumeEstimation<PointT, Sphere> {
 public:
  using Ptr = pcl::shared_ptr<SphereEstimation>;
  using ConstPtr = pcl::shared_ptr<const SphereEstimation>;
  using BoundingVolumeEstimation<PointT, Sphere>::compute;

  void setMethod(SphereMethod method) { options_.method = method; }
  SphereMethod getMethod() const { return options_.method; }

  /// How Ritter's and EPOS's spheres grow; SphereGrowth::deferred by default.
  void setGrowth(SphereGrowth growth) { options_.growth = growth; }
  SphereGrowth getGrowth() const { return options_.growth; }

  /// The smallest sphere, and the proof that it is. See fit_smallest_sphere(). Throws as compute() does, and
  /// std::invalid_argument if another method than SphereMethod::exact is set: no other has a proof.
  EstimationResult compute(Sphere& sphere, SphereCertificate& certificate) const {
    if (options_.method != SphereMethod::exact)
      throw std::invalid_argument("SphereEstimation: only the method exact has a certificate");
    return fit_smallest_sphere(this->input(), sphere, certificate, this->execution());
  }

 protected:
  EstimationResult fit(const PointView& points, Sphere& sphere, const Execution& execution) const override {
    return fit_sphere(points, options_, sphere, execution);
  }

 private:
  SphereOptions options_;
};

/// An oriented box: the smallest that is found unless another method is set. The upright methods' boxes have
/// their axis 2 up and axis 0 along the longer horizontal side. See fit_obb().
template <typename PointT>
class ObbEstimation : public BoundingVolumeEstimation<PointT, Obb> {
 public:
  using Ptr = pcl::shared_ptr<ObbEstimation>;
  using ConstPtr = pcl::shared_ptr<const ObbEstimation>;

  void setMethod(ObbMethod method) { options_.method = method; }
  ObbMethod getMethod() const { return options_.method; }

  /// Against gravity, of any length, z by default: for the upright methods. compute() throws
  /// std::invalid_argument for one that is none.
  void setUpAxis(const Eigen::Vector3d& up) { options_.up = up; }
  const Eigen::Vector3d& getUpAxis() const { return options_.up; }

 protected:
  EstimationResult fit(const PointView& points, Obb& box, const Execution& execution) const override {
    return fit_obb(points, options_, box, execution);
  }

 private:
  ObbOptions options_;
};

/// The smallest ellipsoid. See fit_ellipsoid().
template <typename PointT>
class EllipsoidEstimation : public BoundingVolumeEstimation<PointT, Ellipsoid> {
 public:
  using Ptr = pcl::shared_ptr<EllipsoidEstimation>;
  using ConstPtr = pcl::shared_ptr<const EllipsoidEstimation>;
  using BoundingVolumeEstimation<PointT, Ellipsoid>::compute;

  /// The same, and how near it is to the smallest and why.
  EstimationResult compute(Ellipsoid& ellipsoid, EllipsoidCertificate& certificate) const {
    return fit_ellipsoid(this->input(), ellipsoid, certificate, this->execution());
  }

 protected:
  EstimationResult fit(const PointView& points, Ellipsoid& ellipsoid,
                       const Execution& execution) const override {
    return fit_ellipsoid(points, ellipsoid, execution);
  }
};

/// Whichever of several volumes is the smallest. See fit_smallest().
template <typename PointT>
class BestEstimation : public BoundingVolumeEstimation<PointT, AnyVolume> {
 public:
  using Ptr = pcl::shared_ptr<BestEstimation>;
  using ConstPtr = pcl::shared_ptr<const BestEstimation>;

  /// The methods to choose from; best_candidates() by default. Throws std::invalid_argument, naming it, for a
  /// name that is no method, for `best` itself and for no names.
  void setMethods(const std::vector<std::string>& names) {
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

 protected:
  EstimationResult fit(const PointView& points, AnyVolume& volume,
                       const Execution& execution) const override {
    return fit_smallest(points, among_, volume, execution);
  }

 private:
  std::vector<const Method*> among_ = best_candidates();
};

}  // namespace pcl_bv
