// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "cluster_pass.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/gpu/gpu_fit.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/select_points.h"
#include "pcl_bv/volumes/kdop_sets.h"

namespace pcl_bv {
namespace detail {
namespace {

// The directions of the method, if its volume consists of slabs along them.
std::optional<DirectionSet> slab_directions(const Method& method) {
  if (method.shape == "aabb" || method.shape == "kdop") return method.implementation->directions;
  return std::nullopt;
}

std::optional<DirectionSet> slab_directions(const std::vector<const Method*>& methods) {
  std::vector<const Method*> of_slabs;
  std::copy_if(methods.begin(), methods.end(), std::back_inserter(of_slabs),
               [](const Method* method) { return slab_directions(*method).has_value(); });
  return directions_of(of_slabs);
}

}  // namespace

/// Fits clusters of one cloud. The clusters are ranges, or lists if `indices` is not null.
class ClusterFitter {
 public:
  ClusterFitter(const GpuCloud& cloud, DeviceClusters clusters, const std::vector<const Method*>& methods,
                const MethodOptions& options, const Execution& execution)
      : cloud_(cloud.on_device()), clusters_(std::move(clusters)), options_(options), execution_(execution) {
    if (std::count(methods.begin(), methods.end(), nullptr) > 0)
      throw std::invalid_argument("fit: methods must not have a null method");
    set_ = slab_directions(methods);
    fits_.methods_ = methods;
  }

  ClusterFits run() {
    const FloatEnvironment environment;
    const std::size_t count = clusters_.size();
    fits_.results_.resize(count);
    fits_.others_.resize(fits_.methods_.size());
    std::vector<std::uint8_t> found(count);
    if (set_) found = find_on_device();
    fit_on_processor(found);
    return std::move(fits_);
  }

 private:
  std::vector<std::uint8_t> find_on_device() {
    const std::size_t count = clusters_.size(), directions = direction_count(*set_);
    for (std::size_t k = 0; k < directions; ++k)
      fits_.directions_.push_back(cube_direction(*set_, k));
    if (!can_find_slabs(cloud_, clusters_.indices != nullptr)) {
      fits_.slabs_ = make_slabs(directions, count);
      return std::vector<std::uint8_t>(count);
    }
    ClusterSlabs slabs = find_slabs(cloud_, clusters_, *set_, execution_);
    for_each_range(execution_.parallel, count, 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        if (slabs.found[c] == 0) continue;
        const std::size_t points = clusters_.offsets[c + 1] - clusters_.offsets[c];
        fits_.results_[c] = {EstimationStatus::ok, 3, slabs.valid[c], points - slabs.valid[c], {}};
      }
    });
    fits_.slabs_ = std::move(slabs.slabs);
    return std::move(slabs.found);
  }

  // Fits what the device has not found, and the methods that are not made of slabs.
  void fit_on_processor(const std::vector<std::uint8_t>& found) {
    for (std::size_t m = 0; m < fits_.methods_.size(); ++m) {
      if (slab_directions(*fits_.methods_[m])) continue;
      fits_.others_[m].resize(clusters_.size());
      other_methods_.push_back(fits_.methods_[m]);
    }
    std::vector<std::size_t> numbers;
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
      if (!other_methods_.empty() || found[c] == 0) numbers.push_back(c);
    }
    if (numbers.empty()) return;
    std::vector<std::byte> storage;
    const std::vector<PointView> views = views_of(numbers, storage);
    for_each_view(
        views,
        [&](std::size_t i, const Execution& own) {
          fit_cluster(numbers[i], views[i], found[numbers[i]] == 0, own);
        },
        execution_);
  }

  std::vector<PointView> views_of(const std::vector<std::size_t>& numbers,
                                  std::vector<std::byte>& storage) const {
    PointView points = cloud_.points();
    std::vector<PointView> views;
    if (points.count == 0) points = PointView();  // whose empty lists need no source
    if (clusters_.indices != nullptr) points = cloud_.in_memory({points}, storage).front();
    for (const std::size_t c : numbers) {
      const std::size_t begin = clusters_.offsets[c], count = clusters_.offsets[c + 1] - begin;
      views.push_back(clusters_.indices != nullptr ? select_points(points, clusters_.indices + begin, count)
                                                   : points.slice(begin, count));
    }
    return clusters_.indices != nullptr ? views : cloud_.in_memory(std::move(views), storage);
  }

  void fit_cluster(std::size_t cluster, const PointView& points, bool with_slabs,
                   const Execution& execution) {
    Supports shared;
    const FitExecution prepared =
        share_supports(points, with_slabs ? fits_.methods_ : other_methods_, execution, shared);
    if (set_ && with_slabs)
      store_slabs(cluster, find_supports(points, *set_, SupportDetail::bounds, prepared));
    for (std::size_t m = 0; m < fits_.methods_.size(); ++m) {
      if (fits_.others_[m].empty()) continue;
      fits_.results_[cluster] =
          fit_method(*fits_.methods_[m], points, options_, fits_.others_[m][cluster], prepared);
    }
  }

  void store_slabs(std::size_t cluster, const Supports& supports) {
    fits_.results_[cluster] = result_of(supports);
    double* slab = &fits_.slabs_[2 * cluster * fits_.directions_.size()];
    for (std::size_t k = 0; k < fits_.directions_.size(); ++k) {
      *slab++ = supports.along[k].low;
      *slab++ = supports.along[k].high;
    }
  }

  const DevicePoints& cloud_;
  DeviceClusters clusters_;
  const MethodOptions& options_;
  const Execution& execution_;
  std::optional<DirectionSet> set_;  // directions of the methods that are made of slabs
  std::vector<const Method*> other_methods_;
  ClusterFits fits_;
};

}  // namespace detail

using namespace detail;
namespace {

AnyVolume volume_of_slabs(const Method& method, const std::vector<std::size_t>& directions,
                          const double* slabs) {
  const DirectionSet set = *method.implementation->directions;
  const std::size_t count = direction_count(set);
  SlabVector low(static_cast<Eigen::Index>(count)), high = low;
  for (std::size_t k = 0; k < count; ++k) {
    const auto stored =
        std::find(directions.begin(), directions.end(), cube_direction(set, k)) - directions.begin();
    low[static_cast<Eigen::Index>(k)] = slabs[2 * stored];
    high[static_cast<Eigen::Index>(k)] = slabs[2 * stored + 1];
  }
  if (method.shape == "aabb") return Aabb({low[0], low[1], low[2]}, {high[0], high[1], high[2]});
  return Kdop(kdop_set_of(set), low, high);
}

AnyVolume empty_volume(const Method& method) {
  if (method.shape == "aabb") return Aabb();
  return Kdop(kdop_set_of(*method.implementation->directions));
}

// Throws std::out_of_range for an index that no point has.
void require_indices(const GpuCloud& cloud, const IndexLists& clusters) {
  PointView numbered;
  numbered.count = cloud.size();
  if (cloud.on_device().kept()) numbered = cloud.points();
  numbered.subset(clusters.indices);
}

}  // namespace

Fitted<AnyVolume> ClusterFits::fitted(std::size_t cluster, std::size_t method) const {
  const EstimationResult& found = results_.at(cluster);
  const std::vector<AnyVolume>& others = others_.at(method);
  Fitted<AnyVolume> made;
  static_cast<EstimationResult&>(made) = found;
  if (!others.empty()) {
    made.volume = others[cluster];
  } else if (found.used == 0) {
    made.volume = empty_volume(*methods_[method]);
  } else {
    made.volume = volume_of_slabs(*methods_[method], directions_, &slabs_[2 * cluster * directions_.size()]);
  }
  return made;
}

ClusterFits fit(const GpuCloud& cloud, const std::vector<std::size_t>& offsets,
                const std::vector<const Method*>& methods, const MethodOptions& options,
                const Execution& execution) {
  if (offsets.empty()) throw std::invalid_argument("fit: offsets must have at least one element");
  if (!std::is_sorted(offsets.begin(), offsets.end())) throw std::invalid_argument("fit: offsets descend");
  if (offsets.back() > cloud.size())
    throw std::out_of_range("fit: offset " + std::to_string(offsets.back()) + " is beyond the " +
                            std::to_string(cloud.size()) + " points of the cloud");
  cloud.on_device().context()->require_alive();
  DeviceClusters clusters{{}, nullptr};
  clusters.offsets.assign(offsets.begin(), offsets.end());
  return ClusterFitter(cloud, std::move(clusters), methods, options, execution).run();
}

ClusterFits fit(const GpuCloud& cloud, const IndexLists& clusters, const std::vector<const Method*>& methods,
                const MethodOptions& options, const Execution& execution) {
  if (cloud.on_device().kept() && cloud.points().source != nullptr)
    throw std::invalid_argument("fit: lists of indices need points in memory");
  if (clusters.indices.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("fit: lists have more than 2^32 - 1 indices");
  cloud.on_device().context()->require_alive();
  require_indices(cloud, clusters);
  DeviceClusters on_device{{}, clusters.indices.data()};
  on_device.offsets.assign(clusters.offsets.begin(), clusters.offsets.end());
  return ClusterFitter(cloud, std::move(on_device), methods, options, execution).run();
}

}  // namespace pcl_bv
