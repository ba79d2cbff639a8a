// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "obb_peers.h"

#include <benchmark/benchmark.h>
#include <pcl/common/centroid.h>
#include <pcl/common/common.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#ifdef PCL_BV_BENCH_FEATURES
#include <pcl/features/moment_of_inertia_estimation.h>
#endif

#ifdef PCL_BV_BENCH_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/optimal_bounding_box.h>
#endif

namespace pcl_bv::bench {
namespace {

PeerBox pcl_cheapest(const ObbCloud& cloud) {
  pcl::PointXYZ low, high;
  pcl::getMinMax3D(cloud.points(), low, high);
  benchmark::DoNotOptimize(low);
  benchmark::DoNotOptimize(high);
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();
  Eigen::Vector4f mean = Eigen::Vector4f::Zero();
  pcl::computeMeanAndCovarianceMatrix(cloud.points(), covariance, mean);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(covariance);
  const Eigen::Matrix3f to_axes = solver.eigenvectors().transpose();
  Eigen::Array3f least = Eigen::Array3f::Constant(1e30F), most = -least;
  for (const pcl::PointXYZ& p : cloud.points()) {
    const Eigen::Array3f along = to_axes * (p.getVector3fMap() - mean.head<3>());
    least = least.min(along);
    most = most.max(along);
  }
  return {mean.head<3>().cast<double>(), to_axes.cast<double>(), least.matrix().cast<double>(),
          most.matrix().cast<double>()};
}

#ifdef PCL_BV_BENCH_FEATURES
PeerBox moment_of_inertia(const ObbCloud& cloud, float angle_step) {
  pcl::MomentOfInertiaEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(cloud.pointer());
  estimation.setAngleStep(angle_step);
  estimation.compute();
  pcl::PointXYZ low, high, position;
  Eigen::Matrix3f axes;
  estimation.getOBB(low, high, position, axes);
  return {position.getVector3fMap().cast<double>(), axes.transpose().cast<double>(),
          low.getVector3fMap().cast<double>(), high.getVector3fMap().cast<double>()};
}

PeerBox moment_of_inertia_as_it_comes(const ObbCloud& cloud) {
  return moment_of_inertia(cloud, 10);
}

PeerBox moment_of_inertia_one_axis(const ObbCloud& cloud) {
  return moment_of_inertia(cloud, 360);
}
#endif

#ifdef PCL_BV_BENCH_CGAL
PeerBox cgal(const ObbCloud& cloud) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> points;
  for (const pcl::PointXYZ& p : cloud.points())
    points.emplace_back(p.x, p.y, p.z);
  std::array<Kernel::Point_3, 8> corners;
  CGAL::oriented_bounding_box(points, corners, CGAL::parameters::use_convex_hull(true));
  const auto vector = [](const Kernel::Point_3& p) { return Eigen::Vector3d(p.x(), p.y(), p.z()); };
  PeerBox box{vector(corners[0]), {}, Eigen::Vector3d::Zero(), {}};
  for (const int axis : {0, 1, 2})
    box.axes.row(axis) = vector(corners[2 * axis + 1]) - box.origin;
  box.high = box.axes.rowwise().squaredNorm();
  return box;
}
#endif

}  // namespace

double PeerBox::volume() const {
  return ((high - low).array() / axes.rowwise().norm().array()).prod();
}

std::size_t PeerBox::points_outside(const ObbCloud& cloud) const {
  std::size_t count = 0;
  for (const pcl::PointXYZ& p : cloud.points()) {
    const Eigen::Array3d along = axes * (p.getVector3fMap().cast<double>() - origin);
    count += (along < low.array()).any() || (along > high.array()).any();
  }
  return count;
}

const std::vector<ObbPeer>& obb_peers() {
  static const std::vector<ObbPeer> peers = {
      {"PCL cheapest", "obb-pca", pcl_cheapest},
#ifdef PCL_BV_BENCH_FEATURES
      {"PCL MomentOfInertia", "obb-pca", moment_of_inertia_as_it_comes},
      {"PCL MomentOfInertia, one axis", "obb-pca", moment_of_inertia_one_axis},
#endif
#ifdef PCL_BV_BENCH_CGAL
      {"CGAL oriented_bounding_box", "obb-min", cgal},
#endif
  };
  return peers;
}

}  // namespace pcl_bv::bench
