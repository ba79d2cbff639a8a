// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Another solver's answer to the same question; built where CGAL is installed. Its headers are GPL: nothing
// but this test and the benchmarks includes them.

#include <CGAL/Min_sphere_annulus_d_traits_3.h>
#include <CGAL/Min_sphere_d.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <cmath>

#include "clouds.h"
#include "pcl_bv/fitting/fit.h"

namespace pcl_bv::detail {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using MinSphere = CGAL::Min_sphere_d<CGAL::Min_sphere_annulus_d_traits_3<Kernel>>;

double radius_by_cgal(const PointView& points) {
  std::vector<Kernel::Point_3> valid;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (is_valid(p)) valid.emplace_back(p.x, p.y, p.z);
  }
  MinSphere sphere(valid.begin(), valid.end());
  return std::sqrt(sphere.squared_radius());
}

template <typename T>
void expect_same_radius(const test::TestCloud<T>& cloud) {
  SCOPED_TRACE(cloud.name);
  Sphere sphere = *fit_sphere(cloud.view(), SphereMethod::exact);
  const double theirs = radius_by_cgal(cloud.view());
  EXPECT_NEAR(sphere.radius(), theirs, 1e-12 * theirs);
}

TEST(SmallestSphere, HasTheRadiusThatCgalFinds) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const std::size_t n : {2, 10, 300, 20'000, 300'000}) {
      expect_same_radius(test::gaussian<float>(n, seed));
      expect_same_radius(test::gaussian<double>(n, seed, 3, 20));
    }
  }
}

TEST(SmallestSphere, OfFlatAndLongCloudsHasTheRadiusThatCgalFinds) {
  for (const std::uint64_t seed : {4, 5, 6}) {
    test::TestCloud<double> cloud = test::gaussian<double>(5000, seed);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      cloud.xyz[3 * i + 1] *= 1e-3, cloud.xyz[3 * i + 2] = 0.25;
    cloud.name = "flat";
    expect_same_radius(cloud);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
