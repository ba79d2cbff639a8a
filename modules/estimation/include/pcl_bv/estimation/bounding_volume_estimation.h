// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Estimators of bounding volumes in the style of PCL. Call setInputCloud(), optionally setIndices(), then
// compute().
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
// PCL instantiates PCLBase only for the point types of PCL. To link with other point types, the
// implementation of PCLBase must be included.
#include <pcl/impl/pcl_base.hpp>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"

namespace pcl_bv {

/// Base class of the estimators. The class stores the input and runs one fit or a batch of fits.
///
/// Volumes are in the unit and frame of the points' coordinates; the cloud's sensor pose is not applied.
///
/// \tparam PointT any point type with members x, y, z of type float or double, from PCL or your own.
/// \tparam VolumeT the type of volume that compute() fills.
template <typename PointT, typename VolumeT>
class BoundingVolumeEstimation : public pcl::PCLBase<PointT> {
 public:
  using Base = pcl::PCLBase<PointT>;
  using PointCloud = typename Base::PointCloud;
  using PointCloudConstPtr = typename Base::PointCloudConstPtr;
  using Ptr = pcl::shared_ptr<BoundingVolumeEstimation>;
  using ConstPtr = pcl::shared_ptr<const BoundingVolumeEstimation>;

  // Overridden, because PCLBase::setIndices() cannot remove indices that were set before.
  /// Restricts the fit to the points with these indices. A null pointer removes the restriction.
  void setIndices(const pcl::IndicesPtr& indices) override { this->indices_ = indices; }
  void setIndices(const pcl::IndicesConstPtr& indices) override {
    this->indices_ = indices ? pcl::make_shared<pcl::Indices>(*indices) : nullptr;
  }
  void setIndices(const pcl::PointIndicesConstPtr& indices) override {
    this->indices_ = indices ? pcl::make_shared<pcl::Indices>(indices->indices) : nullptr;
  }
  void setIndices(std::nullptr_t) { this->indices_.reset(); }
  using Base::setIndices;

  /// Sets the number of threads of compute(). 0 uses all processors. 1, the default, uses only the calling
  /// thread. The result does not depend on the number. Fits that take less than about 200 us use one thread.
  void setNumberOfThreads(unsigned threads) { execution_.parallel = Threads{threads}; }

  /// Sets the instruction set, an Isa. The default is Isa::automatic, for which the constructor reads the
  /// environment variable PCL_BV_ISA. The result does not depend on the instruction set. Throws
  /// std::invalid_argument if this build or machine does not support the instruction set. The constructor of
  /// the estimator also throws std::invalid_argument if the value of PCL_BV_ISA is not supported.
  void setInstructionSet(UsableIsa isa) { execution_.isa = isa; }

  /// Fits the volume to the input cloud, or to its points with the indices that were set.
  ///
  /// Points with a coordinate that is not finite are dropped, even if the cloud's is_dense is true. If all
  /// points are dropped, the volume is empty and the status is `no_valid_points`. If the fit fails, the
  /// volume is empty and the result holds the status `failed` and the reason. Throws std::logic_error if no
  /// cloud was set, and std::out_of_range for an index outside the cloud.
  EstimationResult compute(VolumeT& volume) const { return take(fit(input(), execution_), volume); }

  /// Fits one volume to each cluster. Clusters are lists of indices into the input cloud. The indices of
  /// setIndices() are ignored. Volumes and results are in the order of the clusters, with the same bits as
  /// one call of compute() per cluster. A cluster whose fit fails does not affect the others. Throws like the
  /// compute() above. If no cloud was set or an index is outside the cloud, `volumes` stays unchanged.
  std::vector<EstimationResult> compute(const std::vector<pcl::PointIndices>& clusters,
                                        std::vector<VolumeT>& volumes) const {
    std::vector<PointView> views;
    views.reserve(clusters.size());
    for (const pcl::PointIndices& cluster : clusters)
      views.push_back(point_view(cloud(), cluster.indices));
    volumes.assign(clusters.size(), VolumeT());
    std::vector<EstimationResult> results(clusters.size());
    for_each_view(
        views,
        [&](std::size_t c, const Execution& execution) {
          results[c] = take(fit(views[c], execution), volumes[c]);
        },
        execution_);
    return results;
  }

 protected:
  /// Fits the volume to the points. Each estimator implements this function.
  virtual Fitted<VolumeT> fit(const PointView& points, const Execution& execution) const = 0;

  /// Moves the volume to `volume` and returns the result.
  static EstimationResult take(Fitted<VolumeT>&& fitted, VolumeT& volume) {
    volume = std::move(fitted.volume);
    return fitted;
  }

  /// Returns the points that compute() fits: the cloud, or its points with the indices that were set. Throws
  /// as compute() does.
  PointView input() const {
    return this->indices_ ? point_view(cloud(), *this->indices_) : point_view(cloud());
  }
  const Execution& execution() const { return execution_; }

 private:
  const PointCloud& cloud() const {
    if (!this->input_)
      throw std::logic_error("BoundingVolumeEstimation: call setInputCloud() before compute()");
    return *this->input_;
  }

  Execution execution_;
};

/// An estimator for a fit without settings.
template <typename PointT, typename VolumeT,
          Fitted<VolumeT> (*fit_points)(const PointView&, const Execution&)>
class FitEstimation : public BoundingVolumeEstimation<PointT, VolumeT> {
 public:
  using Ptr = pcl::shared_ptr<FitEstimation>;
  using ConstPtr = pcl::shared_ptr<const FitEstimation>;

 protected:
  Fitted<VolumeT> fit(const PointView& points, const Execution& execution) const override {
    return fit_points(points, execution);
  }
};

/// Estimates the axis-aligned box. See fit_aabb().
template <typename PointT>
using AabbEstimation = FitEstimation<PointT, Aabb, fit_aabb>;

/// Estimates the convex hull. See fit_hull().
template <typename PointT>
using HullEstimation = FitEstimation<PointT, Hull, fit_hull>;

/// Estimates a small cylinder. See fit_cylinder().
template <typename PointT>
using CylinderEstimation = FitEstimation<PointT, Cylinder, fit_cylinder>;

/// Estimates a small capsule. See fit_capsule().
template <typename PointT>
using CapsuleEstimation = FitEstimation<PointT, Capsule, fit_capsule>;

/// Estimates the k-DOP along K / 2 built-in directions or along your own directions. K is 6, 14, 18 or 26.
/// See fit_kdop().
template <typename PointT, int K = 26>
class KdopEstimation : public BoundingVolumeEstimation<PointT, Kdop> {
  static_assert(K == 6 || K == 14 || K == 18 || K == 26, "K is 6, 14, 18 or 26");

 public:
  using Ptr = pcl::shared_ptr<KdopEstimation>;
  using ConstPtr = pcl::shared_ptr<const KdopEstimation>;
  using BoundingVolumeEstimation<PointT, Kdop>::compute;

  /// Sets directions that replace the K / 2 built-in directions. Throws std::invalid_argument for a null
  /// pointer.
  void setDirections(std::shared_ptr<const KdopSet> directions) {
    if (!directions)
      throw std::invalid_argument("KdopEstimation::setDirections: directions must not be null");
    directions_ = std::move(directions);
  }
  const std::shared_ptr<const KdopSet>& getDirections() const { return directions_; }

  /// Fits the k-DOP as compute(kdop) does. Also stores in `touching`, for each side of each slab, the index
  /// of a point that touches this side (see SlabPoints). `touching` is empty if there is no valid point.
  EstimationResult compute(Kdop& kdop, SlabPoints& touching) const {
    auto fitted = fit_kdop_with_contacts(this->input(), directions_, this->execution());
    touching = std::move(fitted.contacts);
    return this->take(std::move(fitted), kdop);
  }

 protected:
  Fitted<Kdop> fit(const PointView& points, const Execution& execution) const override {
    return fit_kdop(points, directions_, execution);
  }

 private:
  static const std::shared_ptr<const KdopSet>& default_directions() {
    return K == 6    ? KdopSet::dop6()
           : K == 14 ? KdopSet::dop14()
           : K == 18 ? KdopSet::dop18()
                     : KdopSet::dop26();
  }

  std::shared_ptr<const KdopSet> directions_ = default_directions();
};

/// Estimates a bounding sphere, by default the smallest bounding sphere. See fit_sphere().
template <typename PointT>
class SphereEstimation : public BoundingVolumeEstimation<PointT, Sphere> {
 public:
  using Ptr = pcl::shared_ptr<SphereEstimation>;
  using ConstPtr = pcl::shared_ptr<const SphereEstimation>;
  using BoundingVolumeEstimation<PointT, Sphere>::compute;

  /// Sets the method. The default is SphereMethod::exact.
  void setMethod(SphereMethod method) { options_.method = method; }
  SphereMethod getMethod() const { return options_.method; }

  /// Sets how the methods SphereMethod::ritter and SphereMethod::epos* enlarge the first sphere. The default
  /// is SphereGrowth::deferred.
  void setGrowth(SphereGrowth growth) { options_.growth = growth; }
  SphereGrowth getGrowth() const { return options_.growth; }

  /// Fits the smallest sphere, and stores in `certificate` the proof that no sphere is smaller. See
  /// fit_smallest_sphere(). Throws as compute() does. Also throws std::invalid_argument if a method other
  /// than SphereMethod::exact is set, because the other methods have no proof.
  EstimationResult compute(Sphere& sphere, SphereCertificate& certificate) const {
    if (options_.method != SphereMethod::exact)
      throw std::invalid_argument("SphereEstimation: compute() with a certificate needs SphereMethod::exact");
    auto fitted = fit_smallest_sphere(this->input(), this->execution());
    certificate = fitted.certificate;
    return this->take(std::move(fitted), sphere);
  }

 protected:
  Fitted<Sphere> fit(const PointView& points, const Execution& execution) const override {
    return fit_sphere(points, options_, execution);
  }

 private:
  SphereOptions options_;
};

/// Estimates an oriented box, by default with ObbMethod::minimal. Boxes of the upright methods `yaw` and
/// `lshape` have axis 2 up and axis 0 along the longer horizontal side. See fit_obb().
template <typename PointT>
class ObbEstimation : public BoundingVolumeEstimation<PointT, Obb> {
 public:
  using Ptr = pcl::shared_ptr<ObbEstimation>;
  using ConstPtr = pcl::shared_ptr<const ObbEstimation>;

  /// Sets the method. The default is ObbMethod::minimal.
  void setMethod(ObbMethod method) { options_.method = method; }
  ObbMethod getMethod() const { return options_.method; }

  /// Sets the direction against gravity for the upright methods. The default is z. The length of `up` does
  /// not matter, but compute() throws std::invalid_argument unless the largest component of `up` is from
  /// 1e-30 to 1e30 in magnitude.
  void setUpAxis(const Eigen::Vector3d& up) { options_.up = up; }
  const Eigen::Vector3d& getUpAxis() const { return options_.up; }

 protected:
  Fitted<Obb> fit(const PointView& points, const Execution& execution) const override {
    return fit_obb(points, options_, execution);
  }

 private:
  ObbOptions options_;
};

/// Estimates an upright prism over the convex hull of the points seen from above, or over a concave outline
/// (setConcaveLength()). See fit_prism().
template <typename PointT>
class PrismEstimation : public BoundingVolumeEstimation<PointT, Prism> {
 public:
  using Ptr = pcl::shared_ptr<PrismEstimation>;
  using ConstPtr = pcl::shared_ptr<const PrismEstimation>;

  /// Sets the direction against gravity. The default is z. The length of `up` does not matter, but compute()
  /// throws std::invalid_argument unless the largest component of `up` is from 1e-30 to 1e30 in magnitude.
  void setUpAxis(const Eigen::Vector3d& up) { options_.up = up; }
  const Eigen::Vector3d& getUpAxis() const { return options_.up; }

  /// Sets PrismOptions::concave_length. The default, infinity, gives convex outlines. compute() throws
  /// std::invalid_argument unless the length is above 0.
  void setConcaveLength(double length) { options_.concave_length = length; }
  double getConcaveLength() const { return options_.concave_length; }

 protected:
  Fitted<Prism> fit(const PointView& points, const Execution& execution) const override {
    return fit_prism(points, options_, execution);
  }

 private:
  PrismOptions options_;
};

/// Estimates the smallest ellipsoid. See fit_ellipsoid().
template <typename PointT>
class EllipsoidEstimation : public BoundingVolumeEstimation<PointT, Ellipsoid> {
 public:
  using Ptr = pcl::shared_ptr<EllipsoidEstimation>;
  using ConstPtr = pcl::shared_ptr<const EllipsoidEstimation>;
  using BoundingVolumeEstimation<PointT, Ellipsoid>::compute;

  /// Fits the ellipsoid. Stores in `certificate` a proof of how near the ellipsoid's volume is to the
  /// minimum. See fit_smallest_ellipsoid().
  EstimationResult compute(Ellipsoid& ellipsoid, EllipsoidCertificate& certificate) const {
    auto fitted = fit_smallest_ellipsoid(this->input(), this->execution());
    certificate = std::move(fitted.certificate);
    return this->take(std::move(fitted), ellipsoid);
  }

 protected:
  Fitted<Ellipsoid> fit(const PointView& points, const Execution& execution) const override {
    return fit_ellipsoid(points, execution);
  }
};

/// Fits several methods and returns the smallest of their volumes. See fit_smallest().
template <typename PointT>
class BestEstimation : public BoundingVolumeEstimation<PointT, AnyVolume> {
 public:
  using Ptr = pcl::shared_ptr<BestEstimation>;
  using ConstPtr = pcl::shared_ptr<const BestEstimation>;

  /// Sets the names of the methods to choose from. By default these are the best_candidates(). Throws
  /// std::invalid_argument for an unknown name, for the name `best` and for an empty list. The message
  /// contains the wrong name.
  void setMethods(const std::vector<std::string>& names) {
    std::vector<const Method*> candidates;
    for (const std::string& name : names) {
      candidates.push_back(find_method(name));
      if (candidates.back() == nullptr || candidates.back()->name == "best") {
        throw std::invalid_argument("BestEstimation::setMethods: '" + name +
                                    "' is unknown or is 'best' itself");
      }
    }
    if (candidates.empty())
      throw std::invalid_argument("BestEstimation::setMethods: the list of names is empty");
    candidates_ = std::move(candidates);
  }

 protected:
  Fitted<AnyVolume> fit(const PointView& points, const Execution& execution) const override {
    return fit_smallest(points, candidates_, {}, execution);
  }

 private:
  std::vector<const Method*> candidates_ = best_candidates();
};

}  // namespace pcl_bv
