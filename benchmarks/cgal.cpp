// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// CGAL's solver takes points of its own type: they are made before it is timed, as its users keep them.

#include "cgal.h"

#ifdef PCL_BV_BENCH_CGAL
#include <CGAL/Min_sphere_annulus_d_traits_3.h>
#include <CGAL/Min_sphere_d.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/bounding_box.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fits.h"
#include "pcl_bv/fitting/fit.h"
#endif

namespace pcl_bv::bench {
using namespace detail;

#ifdef PCL_BV_BENCH_CGAL
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using MinSphere = CGAL::Min_sphere_d<CGAL::Min_sphere_annulus_d_traits_3<Kernel>>;
using MinSphereOfPoints =
    CGAL::Min_sphere_of_spheres_d<CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>>;

// Of the last cloud asked for.
const std::vector<Kernel::Point_3>& points_of(const Cloud& cloud) {
  static CloudName made;
  static std::vector<Kernel::Point_3> points;
  if (made == cloud.name) return points;
  points.clear();
  for (std::size_t i = 0; i < cloud.view.count; ++i) {
    const pcl_bv::Coordinates p = load_point(cloud.view, i);
    if (is_valid(p)) points.emplace_back(p.x, p.y, p.z);
  }
  made = cloud.name;
  return points;
}

struct Ball {
  std::array<double, 3> center;
  double squared_radius;
};

Ball min_sphere(const Cloud& cloud) {
  const std::vector<Kernel::Point_3>& points = points_of(cloud);
  const MinSphere sphere(points.begin(), points.end());
  return {{sphere.center().x(), sphere.center().y(), sphere.center().z()}, sphere.squared_radius()};
}

Ball min_sphere_of_spheres(const Cloud& cloud) {
  const std::vector<Kernel::Point_3>& points = points_of(cloud);
  MinSphereOfPoints sphere(points.begin(), points.end());
  Ball ball;
  std::copy_n(sphere.center_cartesian_begin(), 3, ball.center.begin());
  ball.squared_radius = sphere.radius() * sphere.radius();
  return ball;
}

template <Ball (*fit)(const Cloud&)>
std::size_t outside_sphere(Cloud& cloud) {
  const Ball ball = fit(cloud);
  const auto fitted = fit_smallest_sphere(cloud.view);
  const Sphere& ours = fitted.volume;
  const SphereCertificate& certificate = fitted.certificate;
  const double radius = std::sqrt(ball.squared_radius);
  require(radius >= certificate.lower_bound * (1 - 1e-8) && radius <= ours.radius() * (1 + 1e-8),
          "CGAL's sphere differs on " + cloud.name.text());
  const Kernel::Point_3 center(ball.center[0], ball.center[1], ball.center[2]);
  std::size_t count = 0;
  for (const Kernel::Point_3& p : points_of(cloud))
    count += CGAL::squared_distance(p, center) > ball.squared_radius;
  return count;
}

Kernel::Iso_cuboid_3 bounding_box(const Cloud& cloud) {
  const std::vector<Kernel::Point_3>& points = points_of(cloud);
  return CGAL::bounding_box(points.begin(), points.end());
}

std::size_t outside_box(Cloud& cloud) {
  const Kernel::Iso_cuboid_3 box = bounding_box(cloud);
  std::size_t count = 0;
  for (const Kernel::Point_3& p : points_of(cloud))
    count += box.has_on_unbounded_side(p);
  return count;
}

template <Ball (*fit)(const Cloud&)>
Peer sphere_peer(const std::string& name) {
  return {name, "xyz", [](const Cloud& cloud) { benchmark::DoNotOptimize(fit(cloud)); }, outside_sphere<fit>};
}

}  // namespace

const std::vector<Peer>& cgal_spheres() {
  static const std::vector<Peer> all = {sphere_peer<min_sphere>("cgal-min-sphere"),
                                        sphere_peer<min_sphere_of_spheres>("cgal-min-sphere-of-spheres")};
  return all;
}

const std::vector<Peer>& cgal_boxes() {
  static const std::vector<Peer> all = {
      {"cgal-bounding-box", "xyz", [](const Cloud& cloud) { benchmark::DoNotOptimize(bounding_box(cloud)); },
       outside_box}};
  return all;
}
#else
const std::vector<Peer>& cgal_spheres() {
  static const std::vector<Peer> none;
  return none;
}
const std::vector<Peer>& cgal_boxes() {
  return cgal_spheres();
}
#endif

}  // namespace pcl_bv::bench
