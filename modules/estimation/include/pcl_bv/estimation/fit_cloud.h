// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits of a pcl::PointCloud as single function calls, without a class, for example fit_obb(cloud) and
// fit_obb(cloud, indices, ObbMethod::yaw).
#pragma once

#include "pcl_bv/estimation/point_cloud_view.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/summary.h"

namespace pcl_bv {

/// The functions of this header call the function of the same name in fitting/fit.h or fitting/summary.h.
/// They fit all points of the cloud, or only the points with the given indices. They throw std::out_of_range
/// for an index outside the cloud.
template <typename PointT>
Fitted<Aabb> fit_aabb(const pcl::PointCloud<PointT>& cloud, const Execution& execution = {}) {
  return fit_aabb(point_view(cloud), execution);
}
template <typename PointT>
Fitted<Aabb> fit_aabb(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                      const Execution& execution = {}) {
  return fit_aabb(point_view(cloud, indices), execution);
}

template <typename PointT>
Fitted<Kdop> fit_kdop(const pcl::PointCloud<PointT>& cloud,
                      const std::shared_ptr<const KdopSet>& set = KdopSet::dop26(),
                      const Execution& execution = {}) {
  return fit_kdop(point_view(cloud), set, execution);
}
template <typename PointT>
Fitted<Kdop> fit_kdop(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                      const std::shared_ptr<const KdopSet>& set = KdopSet::dop26(),
                      const Execution& execution = {}) {
  return fit_kdop(point_view(cloud, indices), set, execution);
}

template <typename PointT>
Certified<Kdop, SlabPoints> fit_touched_kdop(const pcl::PointCloud<PointT>& cloud,
                                             const std::shared_ptr<const KdopSet>& set = KdopSet::dop26(),
                                             const Execution& execution = {}) {
  return fit_touched_kdop(point_view(cloud), set, execution);
}
template <typename PointT>
Certified<Kdop, SlabPoints> fit_touched_kdop(const pcl::PointCloud<PointT>& cloud,
                                             const pcl::Indices& indices,
                                             const std::shared_ptr<const KdopSet>& set = KdopSet::dop26(),
                                             const Execution& execution = {}) {
  return fit_touched_kdop(point_view(cloud, indices), set, execution);
}

template <typename PointT>
Fitted<Sphere> fit_sphere(const pcl::PointCloud<PointT>& cloud, const SphereOptions& options = {},
                          const Execution& execution = {}) {
  return fit_sphere(point_view(cloud), options, execution);
}
template <typename PointT>
Fitted<Sphere> fit_sphere(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                          const SphereOptions& options = {}, const Execution& execution = {}) {
  return fit_sphere(point_view(cloud, indices), options, execution);
}

template <typename PointT>
Certified<Sphere, SphereCertificate> fit_smallest_sphere(const pcl::PointCloud<PointT>& cloud,
                                                         const Execution& execution = {}) {
  return fit_smallest_sphere(point_view(cloud), execution);
}
template <typename PointT>
Certified<Sphere, SphereCertificate> fit_smallest_sphere(const pcl::PointCloud<PointT>& cloud,
                                                         const pcl::Indices& indices,
                                                         const Execution& execution = {}) {
  return fit_smallest_sphere(point_view(cloud, indices), execution);
}

template <typename PointT>
Fitted<Obb> fit_obb(const pcl::PointCloud<PointT>& cloud, const ObbOptions& options = {},
                    const Execution& execution = {}) {
  return fit_obb(point_view(cloud), options, execution);
}
template <typename PointT>
Fitted<Obb> fit_obb(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                    const ObbOptions& options = {}, const Execution& execution = {}) {
  return fit_obb(point_view(cloud, indices), options, execution);
}

template <typename PointT>
Fitted<Hull> fit_hull(const pcl::PointCloud<PointT>& cloud, const Execution& execution = {}) {
  return fit_hull(point_view(cloud), execution);
}
template <typename PointT>
Fitted<Hull> fit_hull(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                      const Execution& execution = {}) {
  return fit_hull(point_view(cloud, indices), execution);
}

template <typename PointT>
Fitted<Cylinder> fit_cylinder(const pcl::PointCloud<PointT>& cloud, const Execution& execution = {}) {
  return fit_cylinder(point_view(cloud), execution);
}
template <typename PointT>
Fitted<Cylinder> fit_cylinder(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                              const Execution& execution = {}) {
  return fit_cylinder(point_view(cloud, indices), execution);
}

template <typename PointT>
Fitted<Capsule> fit_capsule(const pcl::PointCloud<PointT>& cloud, const Execution& execution = {}) {
  return fit_capsule(point_view(cloud), execution);
}
template <typename PointT>
Fitted<Capsule> fit_capsule(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                            const Execution& execution = {}) {
  return fit_capsule(point_view(cloud, indices), execution);
}

template <typename PointT>
Fitted<Ellipsoid> fit_ellipsoid(const pcl::PointCloud<PointT>& cloud, const Execution& execution = {}) {
  return fit_ellipsoid(point_view(cloud), execution);
}
template <typename PointT>
Fitted<Ellipsoid> fit_ellipsoid(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                                const Execution& execution = {}) {
  return fit_ellipsoid(point_view(cloud, indices), execution);
}

template <typename PointT>
Certified<Ellipsoid, EllipsoidCertificate> fit_smallest_ellipsoid(const pcl::PointCloud<PointT>& cloud,
                                                                  const Execution& execution = {}) {
  return fit_smallest_ellipsoid(point_view(cloud), execution);
}
template <typename PointT>
Certified<Ellipsoid, EllipsoidCertificate> fit_smallest_ellipsoid(const pcl::PointCloud<PointT>& cloud,
                                                                  const pcl::Indices& indices,
                                                                  const Execution& execution = {}) {
  return fit_smallest_ellipsoid(point_view(cloud, indices), execution);
}

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
