// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Names of the rows of trees_benchmark.cpp, and the places that a row asks about.
#pragma once

#include <algorithm>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "pcl_bv/points/isa.h"
#include "program.h"
#include "tree_inputs.h"

namespace pcl_bv::bench {
using namespace detail;

inline std::string tree_input_name(Isa isa, const std::string& scene, std::size_t points) {
  return std::string(isa_name(isa)) + '/' + scene + "/n:" + std::to_string(points);
}

inline std::string over(const std::string& peer, const std::string& what, Isa isa, const std::string& scene,
                        std::size_t points) {
  return "tree/over-" + peer + '/' + what + '/' + tree_input_name(isa, scene, points) + "/threads:1";
}

/// So many that a round takes long enough for the clock, and each finds caches as others left them.
inline std::vector<pcl::PointXYZ> places_of(const TreeInput& input, Question question) {
  const std::vector<pcl::PointXYZ>& all = question == Question::any ? input.centres : input.near;
  std::vector<pcl::PointXYZ> some;
  std::mt19937_64 random(2);
  std::sample(all.begin(), all.end(), std::back_inserter(some), tiny() ? 64 : 1024, random);
  std::shuffle(some.begin(), some.end(), random);
  return some;
}

/// PointTree::first_hit() beside Embree's, in turns: only where that is installed (PCL_BV_BENCH_EMBREE).
void add_rays(Isa isa, const std::string& scene, std::size_t points);

/// VolumeTree beside a loop over all volumes, and a robot's links among points.
void add_volumes(Isa isa);

}  // namespace pcl_bv::bench
