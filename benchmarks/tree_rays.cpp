// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// First hits, beside Embree's.

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/trees/point_tree.h"
#include "timing.h"
#include "tree_rows.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

struct Ray {
  float origin[3], direction[3];
};

// From twice the cloud's size away to places in its box and to places about its points, in turns.
std::vector<Ray> rays_of(const TreeInput& input) {
  std::mt19937_64 random(3);
  std::normal_distribution<float> normal;
  std::vector<Ray> rays;
  const auto in_box = places_of(input, Question::any), near = places_of(input, Question::nearest);
  for (std::size_t i = 0; i < in_box.size(); ++i) {
    const Eigen::Vector3f to = (i % 2 == 0 ? in_box : near)[i].getVector3fMap();
    const Eigen::Vector3f way = Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
    const Eigen::Vector3f origin = to - 2 * input.side * way;
    rays.push_back({{origin.x(), origin.y(), origin.z()}, {way.x(), way.y(), way.z()}});
  }
  return rays;
}

}  // namespace

void add_rays(Isa isa, const std::string& scene, std::size_t points) {
  add_turns(over("embree", "ray", isa, scene, points), kPairs, [=](benchmark::State& state) {
    const TreeInput& input = tree_input(scene, points);
    const float radius = 0.1F * input.radius;
    const auto theirs = embree_spheres(*input.cloud, radius);
    const PointTree ours(point_view(*input.cloud), {Serial{}, isa});
    const std::vector<Ray> rays = rays_of(input);
    const auto by_us = [&](const Ray& r) {
      const auto hit = ours.first_hit({r.origin[0], r.origin[1], r.origin[2]},
                                      {r.direction[0], r.direction[1], r.direction[2]}, radius);
      return hit ? hit->t : std::numeric_limits<double>::infinity();
    };
    double hits = 0, wrong = 0, sum = 0;
    for (const Ray& ray : rays) {
      const double theirs_t = theirs->first_hit(ray.origin, ray.direction), ours_t = by_us(ray);
      hits += std::isfinite(ours_t);
      wrong += !(theirs_t == ours_t || std::abs(theirs_t - ours_t) <= 0.01 * radius);
    }
    compare(
        state,
        [&] {
          for (const Ray& ray : rays)
            benchmark::DoNotOptimize(sum += theirs->first_hit(ray.origin, ray.direction));
        },
        [&] {
          for (const Ray& ray : rays)
            benchmark::DoNotOptimize(sum += by_us(ray));
        });
    state.counters["wrong"] = wrong;
    state.counters["questions"] = static_cast<double>(rays.size());
    state.counters["hits"] = hits;
  });
}

}  // namespace pcl_bv::bench
