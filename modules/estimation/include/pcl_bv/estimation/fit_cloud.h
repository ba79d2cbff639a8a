// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits of a pcl::PointCloud as single function calls, without a class, for example fit_aabb(cloud, box) and
// fit_aabb(cloud, indices, box).
#pragma once

#include "pcl_bv/estimation/point_cloud_view.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/fit_obb.h"
#include "pcl_bv/fitting/summary.h"

namespace pcl_bv {

/// Fits the axis-aligned box of a cloud. See fit_aabb() of fitting/fit.h.
///
/// All functions of fit_cloud.h call the function with the same name for a PointView. They fit all points of
/// the cloud, or only the points with the given indices. They throw std::out_of_range for an index outside
/// the cloud.
template <typename PointT>
EstimationResult fit_aabb(const pcl::PointCloud<PointT>& cloud, Aabb& box, const Execution& execution = {}) {
  return fit_aabb(point_view(cloud), box, execution);
}

template <typename PointT>
EstimationResult fit_aabb(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices, Aabb& box,
                          const Execution& execution = {}) {
  return fit_aabb(point_view(cloud, indices), box, execution);
}

/// Fits the k-DOP of a cloud. See fit_kdop() of fitting/fit.h.
template <typename PointT>
EstimationResult fit_kdop(const pcl::PointCloud<PointT>& cloud, const std::shared_ptr<const KdopSet>& set,
                          Kdop& kdop, const Execution& execution = {}) {
  return fit_kdop(point_view(cloud), set, kdop, execution);
}

template <typename PointT>
EstimationResult fit_kdop(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                          const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          const Execution& execution = {}) {
  return fit_kdop(point_view(cloud, indices), set, kdop, execution);
}

/// Fits the k-DOP of a cloud, and stores the indices of the points that touch each slab.
template <typename PointT>
EstimationResult fit_kdop(const pcl::PointCloud<PointT>& cloud, const std::shared_ptr<const KdopSet>& set,
                          Kdop& kdop, SlabPoints& touching, const Execution& execution = {}) {
  return fit_kdop(point_view(cloud), set, kdop, touching, execution);
}

template <typename PointT>
EstimationResult fit_kdop(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                          const std::shared_ptr<const KdopSet>& set, Kdop& kdop, SlabPoints& touching,
                          const Execution& execution = {}) {
  return fit_kdop(point_view(cloud, indices), set, kdop, touching, execution);
}

/// Fits a sphere to a cloud. See fit_sphere() of fitting/fit.h.
template <typename PointT>
EstimationResult fit_sphere(const pcl::PointCloud<PointT>& cloud, const SphereOptions& options,
                            Sphere& sphere, const Execution& execution = {}) {
  return fit_sphere(point_view(cloud), options, sphere, execution);
}

template <typename PointT>
EstimationResult fit_sphere(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                            const SphereOptions& options, Sphere& sphere, const Execution& execution = {}) {
  return fit_sphere(point_view(cloud, indices), options, sphere, execution);
}

/// Fits an oriented box to a cloud. See fit_obb() of fitting/fit_obb.h.
template <typename PointT>
EstimationResult fit_obb(const pcl::PointCloud<PointT>& cloud, const ObbOptions& options, Obb& box,
                         const Execution& execution = {}) {
  return fit_obb(point_view(cloud), options, box, execution);
}

template <typename PointT>
EstimationResult fit_obb(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                         const ObbOptions& options, Obb& box, const Execution& execution = {}) {
  return fit_obb(point_view(cloud, indices), options, box, execution);
}

/// Fits the smallest sphere of a cloud and stores the proof that no sphere is smaller. See
/// fit_smallest_sphere() of fitting/fit.h.
template <typename PointT>
EstimationResult fit_smallest_sphere(const pcl::PointCloud<PointT>& cloud, Sphere& sphere,
                                     SphereCertificate& certificate, const Execution& execution = {}) {
  return fit_smallest_sphere(point_view(cloud), sphere, certificate, execution);
}

template <typename PointT>
EstimationResult fit_smallest_sphere(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                                     Sphere& sphere, SphereCertificate& certificate,
                                     const Execution& execution = {}) {
  return fit_smallest_sphere(point_view(cloud, indices), sphere, certificate, execution);
}

/// Fits the convex hull of a cloud. See fit_hull() of fitting/fit.h.
template <typename PointT>
EstimationResult fit_hull(const pcl::PointCloud<PointT>& cloud, Hull& hull, const Execution& execution = {}) {
  return fit_hull(point_view(cloud), hull, execution);
}

template <typename PointT>
EstimationResult fit_hull(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices, Hull& hull,
                          const Execution& execution = {}) {
  return fit_hull(point_view(cloud, indices), hull, execution);
}

/// Fits a small cylinder to a cloud. See fit_cylinder() of fitting/fit.h.
template <typename PointT>
EstimationResult fit_cylinder(const pcl::PointCloud<PointT>& cloud, Cylinder& cylinder,
                              const Execution& execution = {}) {
  return fit_cylinder(point_view(cloud), cylinder, execution);
}

template <typename PointT>
EstimationResult fit_cylinder(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                              Cylinder& cylinder, const Execution& execution = {}) {
  return fit_cylinder(point_view(cloud, indices), cylinder, execution);
}

/// Fits a small capsule to a cloud. See fit_capsule() of fitting/fit.h.
template <typename PointT>
EstimationResult fit_capsule(const pcl::PointCloud<PointT>& cloud, Capsule& capsule,
                             const Execution& execution = {}) {
  return fit_capsule(point_view(cloud), capsule, execution);
}

template <typename PointT>
EstimationResult fit_capsule(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                             Capsule& capsule, const Execution& execution = {}) {
  return fit_capsule(point_view(cloud, indices), capsule, execution);
}

/// Fits the smallest ellipsoid of a cloud. See fit_ellipsoid() of fitting/fit.h.
template <typename PointT>
EstimationResult fit_ellipsoid(const pcl::PointCloud<PointT>& cloud, Ellipsoid& ellipsoid,
                               const Execution& execution = {}) {
  return fit_ellipsoid(point_view(cloud), ellipsoid, execution);
}

template <typename PointT>
EstimationResult fit_ellipsoid(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                               Ellipsoid& ellipsoid, const Execution& execution = {}) {
  return fit_ellipsoid(point_view(cloud, indices), ellipsoid, execution);
}

/// Computes box, 26-DOP, centroid and covariance of a cloud in one pass. See summarize() of
/// fitting/summary.h.
template <typename PointT>
CloudSummary summarize(const pcl::PointCloud<PointT>& cloud, const Execution& execution = {}) {
  return summarize(point_view(cloud), execution);
}

template <typename PointT>
CloudSummary summarize(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                       const Execution& execution = {}) {
  return summarize(point_view(cloud, indices), execution);
}

}  // namespace pcl_bv
