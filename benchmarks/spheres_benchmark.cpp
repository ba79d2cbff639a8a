// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's Tables 3 and 4: each sphere method on clouds of the paper's seven sizes, scalar and on each
// instruction set, and its radius over the smallest one (counter `over_optimum`). Beside them the shapes on
// which exact solvers differ and, if installed, CGAL's Min_sphere_d. Results are checked, then timed.

#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/verify.h"
#include "pcl_bv/synth/synth.h"

#ifdef PCL_BV_HAVE_CGAL
#include <CGAL/Min_sphere_annulus_d_traits_3.h>
#include <CGAL/Min_sphere_d.h>
#include <CGAL/Simple_cartesian.h>
#endif

namespace {

using Cloud = std::vector<std::array<float, 4>>;  // as pcl::PointXYZ lies in memory

Cloud from_synth(const std::string& name) {
  const pcl_bv::SynthCloud synth = pcl_bv::make_synth(pcl_bv::parse_synth(name));
  Cloud cloud;
  for (std::size_t i = 0; i < synth.size(); ++i)
    cloud.push_back({synth.xyz[3 * i], synth.xyz[3 * i + 1], synth.xyz[3 * i + 2], 1});
  return cloud;
}

// In random order, which spares block-wise solvers nothing.
Cloud make_shape(const std::string& shape, std::size_t points) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1, 1);
  Cloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    Eigen::Vector3d p(normal(random), normal(random), normal(random));
    if (shape == "cube") p = {uniform(random), uniform(random), uniform(random)};
    if (shape == "ball") p *= std::cbrt((uniform(random) + 1) / 2) / p.norm();
    if (shape == "sphere" || shape == "golfball") p.normalize();
    if (shape == "golfball") {
      p *= 1 - 0.02 * std::max(0.0, std::sin(20 * p.x()) * std::sin(20 * p.y()) * std::sin(20 * p.z()));
    }
    if (shape == "car") {  // three visible sides of a box, with the noise of a LiDAR
      const Eigen::Vector3d half(2.25, 0.9, 0.75);
      const auto side = static_cast<int>(random() % 3);
      const Eigen::Vector3d q(uniform(random), uniform(random), uniform(random));
      p = 0.02 * p + half.cwiseProduct(q) + Eigen::Vector3d(20, 7, 0);
      p[side] += half[side] * (-1 - q[side]);
    }
    cloud.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 1});
  }
  return cloud;
}

const Cloud& cloud_of(const std::string& name) {
  static std::map<std::string, Cloud> clouds;
  const auto [place, fresh] = clouds.try_emplace(name);
  if (fresh) {
    const std::size_t colon = name.find(':');
    place->second = colon == std::string::npos
                        ? from_synth(name)
                        : make_shape(name.substr(0, colon), std::stoul(name.substr(colon + 1)));
  }
  return place->second;
}

pcl_bv::PointView view(const Cloud& cloud) {
  return pcl_bv::PointView::of(cloud.front().data(), sizeof cloud.front(), cloud.size());
}

double smallest_radius(const std::string& name) {
  static std::map<std::string, double> radii;
  const auto [place, fresh] = radii.try_emplace(name);
  if (fresh) {
    pcl_bv::Sphere sphere;
    pcl_bv::SphereCertificate certificate;
    pcl_bv::fit_smallest_sphere(view(cloud_of(name)), sphere, certificate);
    if (!(sphere.radius() <= certificate.lower_bound * (1 + 1e-12)))
      throw std::logic_error("not the smallest");
    place->second = sphere.radius();
  }
  return place->second;
}

void fit(benchmark::State& state, const std::string& cloud_name, const pcl_bv::Method* method,
         pcl_bv::Isa isa, pcl_bv::SphereGrowth growth) {
  const Cloud& cloud = cloud_of(cloud_name);
  const pcl_bv::Execution execution{pcl_bv::Serial{}, isa};
  pcl_bv::AnyVolume volume;
  method->fit(view(cloud), volume, execution, {growth});
  if (pcl_bv::verify(volume, view(cloud)).outside != 0) throw std::logic_error("a point is outside");
  const double radius = std::get<pcl_bv::Sphere>(volume).radius();
  for (auto _ : state) {
    method->fit(view(cloud), volume, execution, {growth});
    benchmark::DoNotOptimize(volume);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cloud.size()));
  state.counters["over_optimum"] = radius / smallest_radius(cloud_name);
}

#ifdef PCL_BV_HAVE_CGAL
void cgal(benchmark::State& state, const std::string& cloud_name) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Traits = CGAL::Min_sphere_annulus_d_traits_3<Kernel>;
  std::vector<Kernel::Point_3> points;
  for (const auto& p : cloud_of(cloud_name))
    points.emplace_back(p[0], p[1], p[2]);
  double radius = 0;
  for (auto _ : state) {
    CGAL::Min_sphere_d<Traits> sphere(points.begin(), points.end());
    radius = std::sqrt(sphere.squared_radius());
    benchmark::DoNotOptimize(radius);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
  state.counters["over_optimum"] = radius / smallest_radius(cloud_name);
  state.counters["difference"] = radius / smallest_radius(cloud_name) - 1;
  if (std::abs(radius / smallest_radius(cloud_name) - 1) > 1e-6) state.SkipWithError("CGAL's radius differs");
}
#endif

template <typename... Arguments>
void add(const std::string& name, Arguments... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMicrosecond);
}

void add_cloud(const std::string& cloud) {
  for (const pcl_bv::Method& method : pcl_bv::methods()) {
    if (method.shape != "sphere") continue;
    for (const pcl_bv::Isa isa : pcl_bv::usable_isas()) {
      add(std::string(method.name) + '/' + cloud + '/' + std::string(pcl_bv::isa_name(isa)), fit, cloud,
          &method, isa, pcl_bv::SphereGrowth::deferred);
    }
  }
#ifdef PCL_BV_HAVE_CGAL
  add("CGAL-Min_sphere_d/" + cloud, cgal, cloud);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  for (const char* size : {"4010", "7260", "30892", "32875", "48485", "100722", "327323"})
    add_cloud(std::string("paper-") + size);
  for (const char* shape : {"gauss", "cube", "ball", "car", "golfball", "sphere"}) {
    for (const char* size : {":300", ":100722", ":1000000"})
      add_cloud(shape + std::string(size));
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
