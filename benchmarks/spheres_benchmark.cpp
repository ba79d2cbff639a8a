// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Each sphere method on shapes that are easy and hard for exact solvers, and each way to grow on one thread
// and on two. Rows as in rows.h.

#include "radii.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

void shapes() {
  for (const std::string shape : {"gauss", "cube", "ball", "car", "golfball", "surface"}) {
    for (const std::size_t points : {300, 100'722, 1'000'000})
      add_spheres({shape, points}, {usable_isas().back()});
  }
}

void growth() {
  const Isa best = usable_isas().back();
  for (const std::string method : {"sphere-ritter", "sphere-epos26"}) {
    for (const std::string way : {"+sequential", "+stationary", "+deferred"}) {
      for (const std::size_t points : {100'722, 1'000'000}) {
        add_sphere(method + way, {Serial{}, best}, "1-thread", {"ball", points});
        add_sphere(method + way, {policy_of(2), best}, "2-threads", {"ball", points});
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  pcl_bv::bench::shapes();
  pcl_bv::bench::growth();
  return pcl_bv::bench::run_program(argc, argv);
}
