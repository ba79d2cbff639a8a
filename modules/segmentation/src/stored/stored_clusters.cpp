// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/stored_clusters.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include "brick_clusters.h"
#include "bricks.h"
#include "components.h"
#include "joined_pieces.h"
#include "pcl_bv/numeric/float_environment.h"
#include "spill_file.h"

namespace pcl_bv::detail {
namespace {

// The points of one cluster in the temporary file.
class SpillSource final : public PointSource {
 public:
  SpillSource(const SpillFile& file, const StoredCluster& cluster, ScalarType scalar)
      : file_(file), cluster_(cluster), scalar_(scalar) {}

  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override {
    const std::size_t step = 3 * size_of(scalar_);
    if (buffer.size() < count * step) buffer.resize(count * step);
    file_.read(cluster_.offset + first * step, buffer.data(), count * step);
    return packed_points(buffer.data(), scalar_, count, first);
  }

 private:
  const SpillFile& file_;
  StoredCluster cluster_;
  ScalarType scalar_;
};

void check_stored(const ClusterOptions& options) {
  check(options);
  if (options.tolerance_per_metre > 0)
    throw std::invalid_argument("stored clusters have no tolerance_per_metre");
  if (options.oversized == Oversized::split)
    throw std::invalid_argument("stored clusters cannot be split: oversized must be drop or keep");
}

double halo_of(const ClusterOptions& options, ScalarType scalar) {
  const double r = options.tolerance;
  const double difference = scalar == ScalarType::float32 ? max_linked_difference(static_cast<float>(r * r))
                                                          : max_linked_difference(r * r);
  // The core condition of a point within one tolerance depends on points within two.
  return (options.min_points > 1 ? 2 : 1) * difference * (1 + 1e-6);
}

// Calls use(point, number) for each valid point. Returns the number of the others.
template <typename Use>
std::size_t for_each_valid(const PointView& points, const Use& use) {
  std::size_t invalid = 0;
  for (std::size_t first = 0; first < points.count; first += kChunkPoints) {
    const LoadedPoints part(points, first, std::min(kChunkPoints, points.count - first));
    for (std::size_t i = 0; i < part.view().count; ++i) {
      const Coordinates p = load_point(part.view(), i);
      if (is_valid(p)) {
        use(p, first + i);
      } else {
        ++invalid;
      }
    }
  }
  return invalid;
}

// Writes a point's coordinates in the scalar type of the cloud, which is exact.
void set_coordinates(const Coordinates& p, ScalarType scalar, std::byte* to) {
  if (scalar == ScalarType::float32) {
    const float xyz[3] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    std::memcpy(to, xyz, sizeof xyz);
  } else {
    const double xyz[3] = {p.x, p.y, p.z};
    std::memcpy(to, xyz, sizeof xyz);
  }
}

// Writes the points to the lists of their bricks. The points of a list are in the order of the cloud.
std::vector<SpillList> distribute(const PointView& points, const Bricks& bricks, SpillFile& file,
                                  std::size_t& invalid) {
  // All lists together wait for 64 MiB, so that blocks are as long as possible.
  const std::size_t block = std::clamp<std::size_t>((64U << 20U) / (bricks.size() + 1), 4096, 1U << 20U);
  std::vector<SpillList> lists(bricks.size());
  std::byte record[kMaxRecordBytes];
  const std::size_t step = 3 * size_of(points.scalar);
  invalid = for_each_valid(points, [&](const Coordinates& p, std::size_t number) {
    const Bricks::Place place = bricks.place(p);
    set_coordinates(p, points.scalar, record);
    const auto add = [&](std::uint32_t brick, std::uint64_t mark) {
      const std::uint64_t marked = number | mark;
      std::memcpy(record + step, &marked, sizeof marked);
      lists[brick].add(file, record, step + sizeof marked, block);
    };
    add(place.own, 0);
    for (std::uint32_t i = 0; i < place.others; ++i)
      add(place.other[i], kOfOtherBrick);
  });
  for (SpillList& list : lists)
    list.finish(file);
  return lists;
}

}  // namespace

struct StoredClusters::State {
  explicit State(const std::filesystem::path& folder) : file(folder) {}

  SpillFile file;
  ScalarType scalar = ScalarType::float32;
  std::vector<StoredCluster> clusters;
  Counts counts;
};

StoredClusters::StoredClusters(const PointView& points, const ClusterOptions& options,
                               const StoredClusterOptions& store, const Execution& execution) {
  const FloatEnvironment environment;
  check_stored(options);
  if (points.indices != nullptr) throw std::invalid_argument("stored clusters take no index list");
  state_ =
      std::make_unique<State>(store.folder.empty() ? std::filesystem::temp_directory_path() : store.folder);
  State& state = *state_;
  state.scalar = points.scalar;
  std::optional<Bricks> bricks;
  const double halo = halo_of(options, points.scalar);
  for_each_valid(points, [&](const Coordinates& p, std::size_t) {
    if (!bricks) bricks.emplace(p, halo);
    bricks->count(p);
  });
  if (!bricks) {
    state.counts.nonfinite = points.count;
    return;
  }
  bricks->divide(store.points_in_memory);
  std::vector<SpillList> lists = distribute(points, *bricks, state.file, state.counts.nonfinite);
  BrickClusterer clusterer(*bricks, points.scalar, options, execution, state.file);
  for (std::uint32_t brick = 0; brick < lists.size(); ++brick) {
    clusterer.add(brick, lists[brick].read(state.file));
    lists[brick] = {};
  }
  state.clusters = clusterer.take_clusters();
  join_pieces(clusterer, points.scalar, state.file, state.clusters);
  select_and_sort(options, state.clusters, state.counts);
  state.counts.noise = clusterer.noise();
}

StoredClusters::~StoredClusters() = default;
StoredClusters::StoredClusters(StoredClusters&&) noexcept = default;
StoredClusters& StoredClusters::operator=(StoredClusters&&) noexcept = default;

std::size_t StoredClusters::size() const {
  return state_->clusters.size();
}

std::size_t StoredClusters::point_count(std::size_t cluster) const {
  return state_->clusters[cluster].points;
}

const Counts& StoredClusters::counts() const {
  return state_->counts;
}

StoredClusters::Points StoredClusters::points(std::size_t cluster) const {
  const State& state = *state_;
  const StoredCluster& stored = state.clusters[cluster];
  Points points;
  if (stored.points <= kChunkPoints) {
    points.bytes_.resize(3 * size_of(state.scalar) * stored.points);
    state.file.read(stored.offset, points.bytes_.data(), points.bytes_.size());
    points.view_ = packed_points(points.bytes_.data(), state.scalar, stored.points);
  } else {
    points.source_ = std::make_unique<SpillSource>(state.file, stored, state.scalar);
    points.view_ = view_of(*points.source_, stored.points, state.scalar);
  }
  return points;
}

}  // namespace pcl_bv::detail
