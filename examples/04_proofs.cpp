// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Proves by exact arithmetic that no point is outside a volume. Also proves that no enclosing sphere is
// smaller than the fitted sphere by more than 1e-12 of the radius.
#include <pcl_bv/core.h>

#include <iostream>
#include <random>
#include <vector>

int main() {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<float> xyz(3 * 10'000);
  for (float& coordinate : xyz) coordinate = normal(random);
  const pcl_bv::PointView points = pcl_bv::PointView::of(xyz.data(), 3 * sizeof(float), xyz.size() / 3);

  std::size_t outside = 0;
  for (const pcl_bv::Method* method : pcl_bv::methods_of_all()) {
    const auto volume = method->fit(points);
    const pcl_bv::Verification proof = pcl_bv::verify(*volume, points);  // by rational arithmetic
    std::cout << method->name << ": " << proof.checked << " points, " << proof.outside << " outside\n";
    outside += proof.outside;
  }

  const auto sphere = pcl_bv::fit_smallest_sphere(points);
  const double least = sphere.certificate.lower_bound;  // computed from at most four of the points
  std::cout << "radius " << sphere->radius() << "; no enclosing sphere has a radius below " << least << "\n";
  return outside == 0 && sphere->radius() <= least * (1 + 1e-12) ? 0 : 1;
}
