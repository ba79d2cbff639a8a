// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "object_fitter.h"

#include <algorithm>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {
namespace {

// Bytes that a point in memory takes while a brick is clustered.
constexpr std::size_t bytes_per_point(ScalarType scalar) {
  return scalar == ScalarType::float32 ? 150 : 250;
}
// Clusters with more points use all threads for each fit.
constexpr std::size_t kManyPoints = 200'000;
// Clusters that a thread takes at a time.
constexpr std::size_t kAtATime = 16;

// Returns the requested methods for objects of a class, in the order of all methods.
std::vector<const Method*> methods_of(const PipelineConfig& config, const ClassTable& table,
                                      std::optional<std::int64_t> value) {
  const std::vector<const Method*>& requested = table.methods_of(value);
  std::vector<const Method*> methods = config.methods();
  std::erase_if(methods, [&](const Method* method) {
    return std::find(requested.begin(), requested.end(), method) == requested.end();
  });
  return methods;
}

}  // namespace

StoredClusterOptions store_options(const Options& options, ScalarType scalar) {
  StoredClusterOptions store;
  store.points_in_memory = std::max<std::size_t>(options.memory_bytes / bytes_per_point(scalar), 1);
  store.keep_visited = options.objects.has_value();
  store.has_labels = options.labels.has_value();
  return store;
}

ObjectFitter::ObjectFitter(const Options& options, const ClassTable& table,
                           std::optional<std::int64_t> class_value)
    : options_(options),
      class_value_(class_value),
      methods_(methods_of(options.pipeline, table, class_value)),
      method_options_(options.pipeline.method_options()),
      execution_(options.pipeline.execution()) {}

void ObjectFitter::visit(std::size_t brick, const std::vector<PointView>& clusters,
                         const Execution& execution) {
  std::vector<Object> objects(clusters.size());
  const Execution serial{Serial{}, execution.isa};
  for_each_range(execution.parallel, clusters.size(), kAtATime, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      objects[i] = fit(clusters[i], serial);
  });
  const std::lock_guard lock(mutex_);
  visited_[brick] = std::move(objects);
}

std::vector<Object> ObjectFitter::fit(const StoredClusters& clusters) {
  std::vector<Object> objects(clusters.size());
  for_each_cluster(clusters, execution_, [&](std::size_t i, const Execution& execution) {
    const auto visited = clusters.visit(i);
    objects[i] = visited ? take(*visited) : fit(clusters.points(i).view(), execution);
  });
  return objects;
}

Object ObjectFitter::fit(const PointView& points, const Execution& execution) const {
  Object object;
  object.verdict = extent_verdict(points, options_.pipeline.cluster, method_options_.up, execution);
  if (object.verdict != ExtentVerdict::keep) return object;
  object.entry.points = points.count;
  object.entry.class_value = class_value_;
  std::vector<Fitted<AnyVolume>> fits = fit_methods(points, methods_, method_options_, execution);
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    VolumeEntry& entry = object.entry.volumes.emplace_back();
    entry.method = methods_[m]->name;
    entry.failed = fits[m].reason;
    entry.volume = std::move(fits[m].volume);
    if (options_.check && entry.failed.empty())
      entry.outside = verify(entry.volume, points, execution).outside;
  }
  return object;
}

void for_each_cluster(const StoredClusters& clusters, const Execution& execution,
                      const std::function<void(std::size_t, const Execution&)>& work) {
  std::size_t first_small = 0;  // clusters are sorted by size
  for (; first_small < clusters.size() && clusters.point_count(first_small) > kManyPoints; ++first_small)
    work(first_small, execution);
  const Execution serial{Serial{}, execution.isa};
  for_each_range(execution.parallel, clusters.size() - first_small, kAtATime,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = first_small + begin; i < first_small + end; ++i)
                     work(i, serial);
                 });
}

}  // namespace pcl_bv::detail
