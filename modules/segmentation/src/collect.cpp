// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "collect.h"

#include <algorithm>
#include <numeric>

namespace pcl_bv::detail {
namespace {

constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t dropped = unseen - 1;  // noise, or a component of a size that is not allowed

// Computes the sizes of the components, and lists the components of allowed sizes in the order of the result.
void select(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node,
            std::uint32_t noise, const ClusterOptions& options, Collector& collector, Clusters& clusters) {
  collector.size.assign(roots.size(), 0);
  for (const std::uint32_t n : node)
    ++collector.size[roots[n]];
  collector.next.assign(roots.size(), unseen);
  collector.selected.clear();
  for (std::uint32_t i = 0; i < node.size(); ++i) {
    const std::uint32_t root = roots[node[i]];
    if (collector.next[root] != unseen) continue;
    collector.next[root] = dropped;
    const std::uint32_t size = collector.size[root];
    if (root == noise) {
      clusters.noise_points += size;
    } else if (size < options.min_size) {
      clusters.small_points += size;
    } else if (size > options.max_size) {
      clusters.large_points += size;
    } else {
      collector.selected.push_back({root, size, i});
    }
  }
  std::sort(collector.selected.begin(), collector.selected.end(), [](const Component& a, const Component& b) {
    return a.size != b.size ? a.size > b.size : a.first_point < b.first_point;
  });
}

void write(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node,
           const std::vector<std::int32_t>& numbers, Collector& collector, Clusters& clusters) {
  std::uint32_t end = static_cast<std::uint32_t>(clusters.indices.size());
  for (const Component& component : collector.selected) {
    collector.next[component.root] = end;
    end += component.size;
    clusters.offsets.push_back(end);
  }
  clusters.indices.resize(end);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::uint32_t& next = collector.next[roots[node[i]]];
    if (next != dropped) clusters.indices[next++] = numbers[i];
  }
}

}  // namespace

void write_clusters(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node,
                    std::uint32_t noise, const std::vector<std::int32_t>& numbers,
                    const ClusterOptions& options, Collector& collector, Clusters& clusters) {
  select(roots, node, noise, options, collector, clusters);
  write(roots, node, numbers, collector, clusters);
}

void append(const Clusters& from, std::size_t cluster, Clusters& to) {
  const std::int32_t* const points = from.list(cluster);
  to.indices.insert(to.indices.end(), points, points + from.list_size(cluster));
  to.offsets.push_back(to.indices.size());
}

void write_sorted(const Clusters& from, std::size_t max_size, std::vector<std::size_t>& order, Clusters& to) {
  order.resize(from.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return from.list_size(a) != from.list_size(b) ? from.list_size(a) > from.list_size(b)
                                                  : *from.list(a) < *from.list(b);
  });
  to.indices.clear();
  to.offsets.assign(1, 0);
  for (const std::size_t i : order) {
    if (from.list_size(i) > max_size) {
      to.large_points += from.list_size(i);
    } else {
      append(from, i, to);
    }
  }
}

}  // namespace pcl_bv::detail
