// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Rows of spheres, which say how tight they are.
#pragma once

#include "cgal.h"
#include "pcl_bv/fitting/fit.h"
#include "rows.h"

namespace pcl_bv::bench {
using namespace detail;

inline const std::vector<std::string>& sphere_methods() {
  static const std::vector<std::string> names = {"sphere-ritter", "sphere-epos6",  "sphere-epos14",
                                                 "sphere-epos26", "sphere-epos98", "sphere-exact"};
  return names;
}

/// Counters: the radius over the smallest one, which is proven (`over_optimum`), and over the longest side of
/// the box (`radius`).
inline void describe_radius(benchmark::State& state, const Fit& fit, const Cloud& cloud) {
  const double radius = std::get<Sphere>(fit.volume(cloud, {})).radius();
  const auto fitted = fit_smallest_sphere(cloud.view);
  const Sphere& smallest = fitted.volume;
  const SphereCertificate& certificate = fitted.certificate;
  require(smallest.radius() <= certificate.lower_bound * (1 + 1e-12),
          cloud.name.text() + ": not the smallest");
  Aabb box = *fit_aabb(cloud.view);
  state.counters["over_optimum"] = radius / smallest.radius();
  state.counters["radius"] = radius / (box.max() - box.min()).maxCoeff();
}

inline void add_sphere(const std::string& work, const Execution& execution, const std::string& how,
                       const CloudName& name) {
  add_fit(work, execution, how, name, describe_radius)->UseRealTime();
}

/// Every method on each of `isas`, the last of which says how tight all are, and CGAL's solvers.
inline void add_spheres(const CloudName& name, const std::vector<Isa>& isas) {
  for (const std::string& method : sphere_methods()) {
    for (const Isa isa : isas) {
      if (isa != isas.back()) {
        add_fit(method, isa, name);
      } else {
        add_fit(method, {Serial{}, isa}, std::string(isa_name(isa)), name, describe_radius);
      }
    }
  }
  for (const Peer& peer : cgal_spheres())
    add_peer(peer, name);
}

}  // namespace pcl_bv::bench
