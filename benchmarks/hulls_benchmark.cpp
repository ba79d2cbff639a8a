// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The hull against what it is made of and what PCL offers: Qhull on all points, and pcl::ConvexHull. Beside
// it the shapes that are fitted to its vertices, with their volumes over the hull's (`over_hull`). Rows as in
// rows.h.

#ifdef PCL_BV_BENCH_SURFACE
#include <pcl/surface/convex_hull.h>
#endif

#include <Eigen/Geometry>
#include <algorithm>

#include "pcl_bv/numeric/float_environment.h"
#include "rows.h"
#ifdef PCL_BV_BENCH_QHULL
#include "qhull_triangles.h"
#endif

namespace pcl_bv::bench {
using namespace detail;
namespace {

void describe_volume(benchmark::State& state, const Fit& fit, const Cloud& cloud) {
  static const Fit hull("hull");
  state.counters["over_hull"] = volume(fit.volume(cloud, {})) / volume(hull.volume(cloud, {}));
}

void add_hull_fit(const std::string& work, Isa isa, const CloudName& name) {
  add_fit(work, {Serial{}, isa}, std::string(isa_name(isa)), name, describe_volume);
}

#ifdef PCL_BV_BENCH_QHULL
// As whoever calls Qhull does it: a copy in double of all points.
void add_plain_qhull(const CloudName& name) {
  add("qhull-of-all-points", "peer", name, [=](benchmark::State& state) {
    const Cloud& points = cloud(name);
    const FloatEnvironment environment;
    time_passes(state, [&] {
      std::vector<Eigen::Vector3d> copy;
      copy.reserve(points.view.count);
      for (std::size_t i = 0; i < points.view.count; ++i) {
        const Coordinates p = load_point(points.view, i);
        copy.emplace_back(p.x, p.y, p.z);
      }
      benchmark::DoNotOptimize(qhull_triangles(copy));
    });
  });
}
#endif

#ifdef PCL_BV_BENCH_SURFACE
// By arithmetic in double: points more than 1e-12 of the cloud's size beyond a triangle's plane.
std::size_t points_outside(const PointView& points, const pcl::PointCloud<pcl::PointXYZ>& vertices,
                           const std::vector<pcl::Vertices>& triangles) {
  const auto vertex = [&](pcl::index_t i) {
    return Eigen::Vector3d(vertices[i].getVector3fMap().cast<double>());
  };
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i)
    center += vertex(static_cast<pcl::index_t>(i)) / static_cast<double>(vertices.size());
  double size = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    size = std::max(size, (vertex(static_cast<pcl::index_t>(i)) - center).norm());
  std::vector<Eigen::Vector4d> planes;  // outward unit normals, and the greatest height that is allowed
  for (const pcl::Vertices& t : triangles) {
    const Eigen::Vector3d a = vertex(t.vertices[0]);
    Eigen::Vector3d normal = (vertex(t.vertices[1]) - a).cross(vertex(t.vertices[2]) - a).normalized();
    if (normal.dot(a - center) < 0) normal = -normal;
    planes.emplace_back(normal.x(), normal.y(), normal.z(), normal.dot(a) + 1e-12 * size);
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    const Eigen::Vector4d q(p.x, p.y, p.z, -1);
    count += std::any_of(planes.begin(), planes.end(),
                         [&](const Eigen::Vector4d& plane) { return plane.dot(q) > 0; });
  }
  return count;
}

void add_pcl(const CloudName& name) {
  add("pcl::ConvexHull", "peer", name, [=](benchmark::State& state) {
    Cloud& points = cloud(name);
    pcl::ConvexHull<pcl::PointXYZ> estimation;
    estimation.setInputCloud(points.pcl);
    estimation.setDimension(3);
    pcl::PointCloud<pcl::PointXYZ> vertices;
    std::vector<pcl::Vertices> polygons;
    time_passes(state, [&] { estimation.reconstruct(vertices, polygons); });
    if (!points.outside.contains("pcl::ConvexHull"))
      points.outside["pcl::ConvexHull"] = points_outside(points.view, vertices, polygons);
    state.counters["outside"] = static_cast<double>(points.outside["pcl::ConvexHull"]);
  });
}
#else
void add_pcl(const CloudName&) {}
#endif

void add_cloud(const CloudName& name) {
  for (const Isa isa : {Isa::scalar, usable_isas().back()})
    add_hull_fit("hull", isa, name);
#ifdef PCL_BV_BENCH_QHULL
  add_plain_qhull(name);
#endif
  add_pcl(name);
  for (const std::string work : {"cylinder", "capsule", "ellipsoid", "best"})
    add_hull_fit(work, usable_isas().back(), name);
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  for (const std::string scene : {"gauss", "car", "cube", "ball"}) {
    for (const std::size_t points : {300, 10'000, 100'722})
      pcl_bv::bench::add_cloud({scene, points});
  }
  for (const std::size_t points : {300, 10'000})  // every point is a vertex
    pcl_bv::bench::add_cloud({"surface", points});
  return pcl_bv::bench::run_program(argc, argv);
}
