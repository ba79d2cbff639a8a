// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// DBSCAN by definition, as loops over all pairs.
#pragma once

#include <cstddef>
#include <map>

#include "reference.h"

namespace pcl_bv::test {

struct Dbscan {
  ClusterList clusters;
  std::size_t noise = 0;
};

// As linked() sums it.
template <typename T>
T rounded_square(const std::array<T, 3>& p, const std::array<T, 3>& q) {
  volatile T sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const volatile T difference = p[k] - q[k];
    const volatile T square = difference * difference;
    sum = sum + square;
  }
  return sum;
}

template <typename T>
Dbscan dbscan(const Cloud<T>& cloud, float tolerance, std::size_t min_points) {
  const auto finite = [](const std::array<T, 3>& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  std::vector<std::vector<std::size_t>> linked_to(cloud.size());
  std::vector<bool> core(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!finite(cloud[i])) continue;
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      if (j != i && finite(cloud[j]) && linked(cloud[i], cloud[j], tolerance)) linked_to[i].push_back(j);
    }
    core[i] = linked_to[i].size() + 1 >= min_points;
  }
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> cluster_of(cloud.size(), none);
  for (std::size_t seed = 0; seed < cloud.size(); ++seed) {
    if (!core[seed] || cluster_of[seed] != none) continue;
    std::vector<std::size_t> queue{seed};
    cluster_of[seed] = seed;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const std::size_t j : linked_to[queue[i]]) {
        if (!core[j] || cluster_of[j] != none) continue;
        cluster_of[j] = seed;
        queue.push_back(j);
      }
    }
  }
  Dbscan result;
  std::map<std::size_t, std::vector<std::int32_t>> lists;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!finite(cloud[i])) continue;
    std::size_t nearest = core[i] ? i : none;
    for (const std::size_t j : linked_to[i]) {
      if (core[i] || !core[j]) continue;
      if (nearest == none || rounded_square(cloud[i], cloud[j]) < rounded_square(cloud[i], cloud[nearest]))
        nearest = j;
    }
    if (nearest == none) {
      ++result.noise;
    } else {
      lists[cluster_of[nearest]].push_back(static_cast<std::int32_t>(i));
    }
  }
  for (auto& list : lists)
    result.clusters.push_back(std::move(list.second));
  std::sort(result.clusters.begin(), result.clusters.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return result;
}

}  // namespace pcl_bv::test
