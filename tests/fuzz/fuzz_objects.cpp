// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as a file of objects, behind right check sums, and what merging the shares of the file gives.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "memory_file.h"
#include "object_parts.h"
#include "pcl_bv/report/cluster_json.h"
#include "pcl_bv/report/object_file.h"
#include "pcl_bv/segmentation/stored_clusters.h"

namespace {

using namespace pcl_bv;
using namespace pcl_bv::detail;
using Shares = std::vector<std::unique_ptr<ObjectFile>>;

void require(bool holds, const char* rule) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", rule);
  std::abort();
}

std::vector<const ClusterShare*> pointers(const Shares& shares) {
  std::vector<const ClusterShare*> all;
  for (const auto& share : shares)
    all.push_back(share.get());
  return all;
}

// Opens the shares as parts of one cloud.
Shares open(const std::string& content) {
  static MemoryFile file;
  file.assign(content);
  Shares shares = open_object_file(file.path());
  std::uint64_t points = 0;
  for (const auto& share : shares) {
    share->first_number = points;
    points += share->header().cloud.cloud_points;
  }
  return shares;
}

std::uint64_t points_in(const Shares& shares) {
  std::uint64_t points = 0;
  for (const auto& share : shares)
    for (const ShareRun& run : share->runs())
      points += run.points;
  return points;
}

// Reads all that merging reads: the texts of known clusters, the points of the others.
void check_clusters(const StoredClusters& clusters, const Shares& shares, bool known, const Counts& counts) {
  std::uint64_t points = counts.small + counts.large + counts.noise;
  volatile double sum = 0;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    points += clusters.point_count(i);
    const auto component = clusters.component(i);
    if (known && component && shares[component->share]->has_text(component->number)) {
      try {
        static_cast<void>(read_cluster_json(shares[component->share]->text(component->number).value()));
      } catch (const IoError&) {
      }
      continue;
    }
    const StoredClusters::Points found = clusters.points(i);
    require(found.view().count == clusters.point_count(i), "a cluster has its points");
    for (std::size_t p = 0; p < found.view().count; ++p)
      sum = sum + load_point(found.view(), p).x;
  }
  require(points == points_in(shares), "each point is in one cluster or counted");
}

void merge(const Shares& shares, const ObjectChoices& choices) {
  StoredClusterOptions store;
  store.points_in_memory = choices.few_in_memory ? 4 : 1000;
  store.is_known = [&](const ComponentOfShare& component) {
    return choices.known && shares[component.share]->has_text(component.number);
  };
  try {
    const StoredClusters clusters(pointers(shares), fuzzed_options(choices), store,
                                  {Serial{}, UsableIsa(Isa::automatic)});
    check_clusters(clusters, shares, choices.known, clusters.counts());
  } catch (const ShareError&) {
    store.on_lost = [](const ShareError&, std::uint64_t points) { require(points > 0, "points are lost"); };
    const StoredClusters left(pointers(shares), fuzzed_options(choices), store,
                              {Serial{}, UsableIsa(Isa::automatic)});
    for (std::size_t i = 0; i < left.size() && !choices.known; ++i)
      require(left.points(i).view().count == left.point_count(i), "a cluster has its points");
  } catch (const std::invalid_argument&) {
    bool same = true;
    for (const auto& share : shares)
      same = same && share->scalar() == shares.front()->scalar();
    require(!same, "shares with points of one type are arguments");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const ObjectChoices choices(*data);
  const std::string_view content(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    merge(open(repaired_objects(content, choices)), choices);
  } catch (const IoError&) {
  } catch (const ShareError& error) {
    require(std::string_view(error.what()).size() < 200, "a reason is short");
  } catch (const std::length_error&) {
  }
  return 0;
}
