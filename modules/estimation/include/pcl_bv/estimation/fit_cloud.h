// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Views of a pcl::PointCloud, and fits as single function calls, for example fit_obb(cloud) and
// fit_obb(cloud, indices, ObbMethod::yaw).
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Returns a view of all points of a cloud. PointT is any type with members x, y, z that are adjacent in
/// memory and either all float or all double. The cloud must outlive the view.
template <typename PointT>
PointView point_view(const pcl::PointCloud<PointT>& cloud) {
  return view_records(cloud.points.data(), cloud.size());
}

/// Returns a view of the points with these indices, in the order of `indices`. The cloud and `indices` must
/// outlive the view. Throws std::out_of_range for an index outside the cloud; the message contains the index.
template <typename PointT>
PointView point_view(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  static_assert(sizeof(pcl::index_t) == sizeof(std::int32_t),
                "PCL is built with an index type other than 32-bit integers");
  return point_view(cloud).subset(indices.data(), indices.size());
}

/// Each function below calls the function of the same name in fitting/fit.h. The points are all points of the
/// cloud or, with the argument `indices`, only the points with these indices. Throws std::out_of_range for an
/// index outside the cloud.
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
KdopWithContacts fit_kdop_with_contacts(const pcl::PointCloud<PointT>& cloud,
                                        const std::shared_ptr<const KdopSet>& set = KdopSet::dop26(),
                                        const Execution& execution = {}) {
  return fit_kdop_with_contacts(point_view(cloud), set, execution);
}
template <typename PointT>
KdopWithContacts fit_kdop_with_contacts(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                                        const std::shared_ptr<const KdopSet>& set = KdopSet::dop26(),
                                        const Execution& execution = {}) {
  return fit_kdop_with_contacts(point_view(cloud, indices), set, execution);
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
Fitted<Prism> fit_prism(const pcl::PointCloud<PointT>& cloud, const PrismOptions& options = {},
                        const Execution& execution = {}) {
  return fit_prism(point_view(cloud), options, execution);
}
template <typename PointT>
Fitted<Prism> fit_prism(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                        const PrismOptions& options = {}, const Execution& execution = {}) {
  return fit_prism(point_view(cloud, indices), options, execution);
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
