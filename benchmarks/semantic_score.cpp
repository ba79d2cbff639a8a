// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semantic_score.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "pcl_bv/segmentation/class_clusters.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

enum SemanticClass : std::uint32_t {
  unlabelled = 0,
  outlier = 1,
  road = 40,
  parking = 44,
  sidewalk = 48,
  other_ground = 49,
  lane_marking = 60,
  vegetation_class = 70,
  terrain = 72
};

std::uint32_t class_of(std::uint32_t label) {
  return label & 0xFFFF;
}

bool is_ground(std::uint32_t label) {
  constexpr std::uint32_t ground[] = {road, parking, sidewalk, other_ground, lane_marking, terrain};
  return std::find(std::begin(ground), std::end(ground), class_of(label)) != std::end(ground);
}

double share(std::size_t part, std::size_t all) {
  return all == 0 ? 1 : static_cast<double>(part) / static_cast<double>(all);
}

// Returns the sum, over the groups of `by`, of the entropy of `of` among the group's points. Group 0 is left
// out.
double sum_of_entropies(std::span<const std::uint32_t> by, std::span<const std::uint32_t> of) {
  std::map<std::uint32_t, std::map<std::uint32_t, std::size_t>> groups;
  for (std::size_t i = 0; i < by.size(); ++i) {
    if (by[i] != 0) ++groups[by[i]][of[i]];
  }
  double sum = 0;
  for (const auto& [group, parts] : groups) {
    std::size_t all = 0;
    for (const auto& [part, points] : parts)
      all += points;
    for (const auto& [part, points] : parts)
      sum -= share(points, all) * std::log(share(points, all));
  }
  return sum;
}

}  // namespace

double GroundCounts::recall() const {
  return share(true_positive, true_positive + false_negative);
}
double GroundCounts::precision() const {
  return share(true_positive, true_positive + false_positive);
}
double GroundCounts::f1() const {
  return share(2 * true_positive, 2 * true_positive + false_positive + false_negative);
}
double GroundCounts::accuracy() const {
  return share(true_positive + true_negative,
               true_positive + true_negative + false_positive + false_negative);
}

GroundCounts count_ground(std::span<const std::uint32_t> labels, std::span<const float> z,
                          std::span<const std::uint8_t> found, Vegetation vegetation, double low) {
  GroundCounts counts;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::uint32_t kind = class_of(labels[i]);
    if (kind == unlabelled || kind == outlier) continue;
    if (kind == vegetation_class && vegetation == Vegetation::not_counted) continue;
    const bool low_vegetation = kind == vegetation_class && vegetation == Vegetation::ground && z[i] < low;
    const bool ground = is_ground(labels[i]) || low_vegetation;
    if (ground) {
      ++(found[i] != 0 ? counts.true_positive : counts.false_negative);
    } else {
      ++(found[i] != 0 ? counts.false_positive : counts.true_negative);
    }
  }
  return counts;
}

std::vector<std::uint32_t> true_segments(const PointView& points, std::span<const std::uint32_t> labels) {
  const std::vector<std::int64_t> classes(labels.begin(), labels.end());
  ClusterOptions options;
  options.tolerance = 1;
  options.min_size = 10;
  options.max_size = 300'000;
  Clusters clusters;
  std::vector<std::int64_t> class_of_cluster;
  ClassClusterer().extract(points, classes, options, {}, clusters, class_of_cluster);
  std::vector<std::uint32_t> segments(labels.size(), 0);
  std::uint32_t number = 0;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const auto label = static_cast<std::uint32_t>(class_of_cluster[c]);
    if (is_ground(label) || class_of(label) == unlabelled) continue;
    ++number;
    for (std::size_t i = 0; i < clusters.list_size(c); ++i)
      segments[static_cast<std::size_t>(clusters.list(c)[i])] = number;
  }
  return segments;
}

SegmentEntropy segment_entropy(std::span<const std::uint32_t> truth, std::span<const std::uint32_t> found) {
  return {sum_of_entropies(found, truth), sum_of_entropies(truth, found)};
}

void SweepMean::add(double value) {
  ++sweeps_;
  sum_ += value;
  squares_ += value * value;
}
double SweepMean::mean() const {
  return sweeps_ == 0 ? 0 : sum_ / static_cast<double>(sweeps_);
}
double SweepMean::deviation() const {
  return sweeps_ == 0 ? 0
                      : std::sqrt(std::max(0.0, squares_ / static_cast<double>(sweeps_) - mean() * mean()));
}

}  // namespace pcl_bv::bench
