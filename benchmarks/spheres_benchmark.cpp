// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's Tables 3 and 4: each sphere method on clouds of the paper's seven sizes and on shapes that are
// easy and hard for exact solvers, with the radius over the smallest one (`over_optimum`) and in units of the
// longest side of the box (`radius`). Each way to grow on one thread and on two. Rows as in rows.h.

#include <Eigen/Core>

#include "cgal.h"
#include "pcl_bv/fitting/fit.h"
#include "rows.h"

namespace pcl_bv::bench {
namespace {

const std::vector<std::string> kMethods = {"sphere-ritter", "sphere-epos6",  "sphere-epos14",
                                           "sphere-epos26", "sphere-epos98", "sphere-exact"};

void count_radius(benchmark::State& state, const Fit& fit, const Cloud& cloud) {
  const double radius = std::get<Sphere>(fit.volume(cloud, {})).radius();
  Sphere smallest;
  SphereCertificate certificate;
  fit_smallest_sphere(cloud.view, smallest, certificate);
  require(smallest.radius() <= certificate.lower_bound * (1 + 1e-12),
          cloud.name.text() + ": not the smallest");
  Aabb box;
  fit_aabb(cloud.view, box);
  state.counters["over_optimum"] = radius / smallest.radius();
  state.counters["radius"] = radius / (box.max() - box.min()).maxCoeff();
}

void add_sphere(const std::string& work, const Execution& execution, const CloudName& name,
                const std::string& how) {
  const Fit fit(work);
  add(work, how, name, [=](benchmark::State& state) {
    Cloud& points = cloud(name);
    fit.check(points, execution);
    count_radius(state, fit, points);
    time_passes(state, points, [&] { fit(points, execution); });
  })->UseRealTime();
}

void add_methods(const CloudName& name, const std::vector<Isa>& sets) {
  for (const std::string& method : kMethods) {
    for (const Isa isa : sets)
      add_sphere(method, {Serial{}, isa}, name, std::string(isa_name(isa)));
  }
  if (cgal_min_sphere() != nullptr) add_peer(*cgal_min_sphere(), name);
}

void tables_of_the_paper() {
  for (const std::size_t points : kPaperSizes)
    add_methods({"paper", points}, usable_isas());
}

void shapes() {
  const Isa best = usable_isas().back();
  for (const std::string shape : {"gauss", "cube", "ball", "car", "golfball", "surface"}) {
    for (const std::size_t points : {300, 100'722, 1'000'000})
      add_methods({shape, points}, {best});
  }
}

void growth() {
  const Isa best = usable_isas().back();
  for (const std::string method : {"sphere-ritter", "sphere-epos26"}) {
    for (const std::string way : {"+sequential", "+stationary", "+deferred"}) {
      for (const std::size_t points : {100'722, 1'000'000}) {
        add_sphere(method + way, {Serial{}, best}, {"ball", points}, "1-thread");
        add_sphere(method + way, {OpenMP{2}, best}, {"ball", points}, "2-threads");
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  pcl_bv::bench::tables_of_the_paper();
  pcl_bv::bench::shapes();
  pcl_bv::bench::growth();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
