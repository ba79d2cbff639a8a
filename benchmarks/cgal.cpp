// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// CGAL's solver takes points of its own type: they are made before it is timed, as its users keep them.

#include "cgal.h"

#ifdef PCL_BV_BENCH_CGAL
#include <CGAL/Min_sphere_annulus_d_traits_3.h>
#include <CGAL/Min_sphere_d.h>
#include <CGAL/Simple_cartesian.h>
#include <benchmark/benchmark.h>

#include <cmath>

#include "fits.h"
#include "pcl_bv/fitting/fit.h"
#endif

namespace pcl_bv::bench {

#ifdef PCL_BV_BENCH_CGAL
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using MinSphere = CGAL::Min_sphere_d<CGAL::Min_sphere_annulus_d_traits_3<Kernel>>;

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

MinSphere fit(const Cloud& cloud) {
  const std::vector<Kernel::Point_3>& points = points_of(cloud);
  return {points.begin(), points.end()};
}

std::size_t outside(Cloud& cloud) {
  MinSphere sphere = fit(cloud);
  Sphere ours;
  SphereCertificate certificate;
  fit_smallest_sphere(cloud.view, ours, certificate);
  const double radius = std::sqrt(sphere.squared_radius());
  require(radius >= certificate.lower_bound * (1 - 1e-9) && radius <= ours.radius() * (1 + 1e-9),
          "cgal-min-sphere differs on " + cloud.name.text());
  const Kernel::Point_3 center = sphere.center();
  std::size_t count = 0;
  for (const Kernel::Point_3& p : points_of(cloud))
    count += CGAL::squared_distance(p, center) > sphere.squared_radius();
  return count;
}

}  // namespace

const Peer* cgal_min_sphere() {
  static const Peer peer{"cgal-min-sphere", "xyz",
                         [](const Cloud& cloud) { benchmark::DoNotOptimize(fit(cloud).squared_radius()); },
                         outside};
  return &peer;
}
#else
const Peer* cgal_min_sphere() {
  return nullptr;
}
#endif

}  // namespace pcl_bv::bench
