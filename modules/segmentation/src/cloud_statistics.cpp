// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the median spacing without an exact nearest-neighbour search for all samples. The smallest distance
// found so far for a sample is an upper bound of its spacing. So the median of these bounds is at least the
// median of the spacings. Each point is compared only with the samples whose distance is at most the median
// of the bounds. A larger distance could only lower a bound above the median, and the bound would stay above
// it. So the median would not change.

#include "pcl_bv/segmentation/cloud_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr std::size_t kMaxSamples = 1000;

// The first bound of a sample's spacing is computed from this number of points before the sample in the
// cloud, and from as many after it.
constexpr std::size_t kNeighboursInList = 64;

bool is_no_return(const Coordinates& p) {
  return p.x == 0 && p.y == 0 && p.z == 0;
}

bool is_used(const Coordinates& p) {
  return is_valid(p) && !is_no_return(p);
}

double distance(const Coordinates& a, const Coordinates& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

struct Sample {
  Coordinates point;
  std::size_t index;
  double nearest;  // smallest distance found so far
};

struct ChunkCounts {
  std::size_t used = 0, nonfinite = 0, zero = 0;
  Aabb box;
};

ChunkCounts count_points(const PointView& points) {
  ChunkCounts found;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) {
      ++found.nonfinite;
    } else if (is_no_return(p)) {
      ++found.zero;
    } else {
      ++found.used;
      found.box.extend({p.x, p.y, p.z});
    }
  }
  return found;
}

double nearest_listed(const PointView& points, std::size_t i, const Coordinates& p) {
  double best = std::numeric_limits<double>::infinity();
  const std::size_t end = std::min(points.count, i + kNeighboursInList + 1);
  for (std::size_t j = i - std::min(i, kNeighboursInList); j < end; ++j) {
    const Coordinates q = load_point(points, j);
    if (j != i && is_used(q)) best = std::min(best, distance(p, q));
  }
  return best;
}

// Takes the samples of a chunk. The samples of all chunks are evenly spaced among the points of the cloud for
// which is_used() holds. `used` is the number of these points, and `before` is their number in earlier
// chunks.
std::vector<Sample> take_samples(const PointView& points, std::size_t before, std::size_t used) {
  const std::size_t samples = std::min(used, kMaxSamples);
  std::vector<Sample> taken;
  std::size_t k = (before * samples + used - 1) / used;  // sample k is used point number k * used / samples
  for (std::size_t i = 0, rank = before; i < points.count && k < samples; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_used(p)) continue;
    if (rank++ != k * used / samples) continue;
    taken.push_back({p, points.index(i), nearest_listed(points, i, p)});
    ++k;
  }
  return taken;
}

double median(const std::vector<Sample>& samples) {
  std::vector<double> distances;
  distances.reserve(samples.size());
  for (const Sample& sample : samples)
    distances.push_back(sample.nearest);
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

// Compares points with the samples, which are sorted along `axis`, and lowers the distances of the samples.
// The search radius is the median of these distances, so the radius shrinks.
void lower_distances(const PointView& points, double Coordinates::*axis, std::vector<Sample>& samples) {
  constexpr std::size_t points_per_update = 4096;
  const auto before = [&](const Sample& sample, double at) { return sample.point.*axis < at; };
  double radius = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    if (i % points_per_update == 0) radius = median(samples);
    const Coordinates p = load_point(points, i);
    if (!is_used(p)) continue;
    auto sample = std::lower_bound(samples.begin(), samples.end(), p.*axis - radius, before);
    for (; sample != samples.end() && sample->point.*axis <= p.*axis + radius; ++sample) {
      const Coordinates& q = sample->point;
      const bool near =
          std::abs(p.x - q.x) <= radius && std::abs(p.y - q.y) <= radius && std::abs(p.z - q.z) <= radius;
      if (near && sample->index != points.index(i))
        sample->nearest = std::min(sample->nearest, distance(p, q));
    }
  }
}

double Coordinates::*longest_axis(const Aabb& box) {
  Eigen::Index axis = 0;
  (box.max() - box.min()).maxCoeff(&axis);
  return axis == 0 ? &Coordinates::x : axis == 1 ? &Coordinates::y : &Coordinates::z;
}

std::vector<Sample> all_samples(const PointView& points, const std::vector<ChunkCounts>& chunks,
                                std::size_t used) {
  std::vector<Sample> samples;
  std::size_t before = 0;
  for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
    const LoadedPoints part = load_chunk(points, chunk);
    for (const Sample& taken : take_samples(part.view(), before, used))
      samples.push_back(taken);
    before += chunks[chunk].used;
  }
  return samples;
}

double spacing(const PointView& points, std::vector<Sample> samples, const Aabb& box,
               const ParallelPolicy& policy) {
  double Coordinates::*const axis = longest_axis(box);
  std::sort(samples.begin(), samples.end(),
            [&](const Sample& a, const Sample& b) { return a.point.*axis < b.point.*axis; });
  std::mutex merging;  // the order of merging does not change minima
  for_each_chunk(policy, chunk_count(points.count), [&](std::size_t chunk) {
    std::vector<Sample> mine;
    {
      const std::lock_guard lock(merging);
      mine = samples;
    }
    lower_distances(load_chunk(points, chunk).view(), axis, mine);
    const std::lock_guard lock(merging);
    for (std::size_t k = 0; k < mine.size(); ++k)
      samples[k].nearest = std::min(samples[k].nearest, mine[k].nearest);
  });
  return median(samples);
}

}  // namespace

CloudStatistics cloud_statistics(const PointView& points, const Execution& execution) {
  const ParallelPolicy& policy = execution.parallel;
  CloudStatistics found;
  std::vector<ChunkCounts> chunks(chunk_count(points.count));
  for_each_chunk(policy, chunks.size(),
                 [&](std::size_t chunk) { chunks[chunk] = count_points(load_chunk(points, chunk).view()); });
  std::size_t used = 0;
  for (const ChunkCounts& chunk : chunks) {
    used += chunk.used;
    found.nonfinite += chunk.nonfinite;
    found.zero += chunk.zero;
    found.box.merge(chunk.box);
  }
  if (used >= 2) found.spacing = spacing(points, all_samples(points, chunks, used), found.box, policy);
  return found;
}

}  // namespace pcl_bv
