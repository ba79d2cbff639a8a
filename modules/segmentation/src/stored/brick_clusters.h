// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters the points of bricks one after another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bricks.h"
#include "components.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/segmentation/clusters.h"
#include "spill_file.h"

namespace pcl_bv::detail {

/// A record of a brick has the coordinates of a point and its number in the cloud, in 8 bytes.
inline constexpr std::size_t kNumberBytes = sizeof(std::uint64_t);
inline constexpr std::size_t kMaxRecordBytes = 3 * sizeof(double) + kNumberBytes;
constexpr std::size_t record_bytes(ScalarType scalar) {
  return 3 * size_of(scalar) + kNumberBytes;
}
/// Set in the number of a point that belongs to another brick.
inline constexpr std::uint64_t kOfOtherBrick = std::uint64_t{1} << 63;
/// Set in the number of a point that belongs to the brick and that other bricks have, too.
inline constexpr std::uint64_t kInOtherBricks = std::uint64_t{1} << 62;
inline constexpr std::uint64_t kNumberMask = kInOtherBricks - 1;

/// Returns whether clusters of this number of points are in the result.
inline bool is_size_allowed(const ClusterOptions& options, std::uint64_t points) {
  return points >= options.min_size && (points <= options.max_size || options.oversized == Oversized::keep);
}

/// Adds `added` points of a cluster that has a number of points that is not allowed.
inline void count_dropped(const ClusterOptions& options, std::uint64_t added, std::uint64_t points,
                          Counts& counts) {
  (points < options.min_size ? counts.small : counts.large) += added;
}

/// A cluster whose points are in the temporary file, coordinates only.
struct StoredCluster {
  std::uint64_t offset, points;
  std::uint64_t first_number;  ///< Smallest number of its points.
};

/// The points of a brick that belong to one component of the cloud, as records in the temporary file. The
/// component has points in other bricks, too.
struct Piece {
  std::uint64_t offset, points;
};

/// A core point that two bricks have, and its piece in one of them.
struct SharedPoint {
  std::uint64_t number;
  std::uint32_t piece;
  std::uint32_t owner;  ///< The brick to which the point belongs.
};

class BrickClusterer {
 public:
  BrickClusterer(const Bricks& bricks, ScalarType scalar, const ClusterOptions& options,
                 const Execution& execution, SpillFile& file);

  /// Adds a brick with its records. Bricks must come in ascending order.
  void add(std::uint32_t brick, const std::vector<std::byte>& records);

  /// Clusters with all their points in one brick. To be called once.
  std::vector<StoredCluster> take_clusters() { return std::move(clusters_); }

  /// Points of noise, and of clusters that are dropped because of their size and have no piece.
  const Counts& counts() const { return counts_; }
  const std::vector<Piece>& pieces() const { return pieces_; }

  /// Returns the shared points of a brick that belong to it, by ascending number.
  std::vector<SharedPoint> own_points(std::uint32_t brick) const { return read(own_[brick]); }
  /// Returns the shared points of a brick that belong to other bricks, by owner and ascending number.
  std::vector<SharedPoint> other_points(std::uint32_t brick) const { return read(others_[brick]); }
  std::size_t brick_count() const { return own_.size(); }

 private:
  // A component of the brick that is added.
  struct Component {
    std::uint64_t points = 0;  // that belong to the brick
    bool shared = false;       // whether it has a core point that two bricks have
    bool seen = false;         // whether it is in clusters_
    std::uint32_t piece = 0;   // if it is shared
    std::uint64_t next = 0;    // position of its next point in a buffer
  };

  std::uint64_t number_at(const std::byte* record) const;
  void measure(const std::vector<std::byte>& records);
  void make_pieces();
  void write_shared(std::uint32_t brick, const std::vector<std::byte>& records);
  void write_points(const std::vector<std::byte>& records);
  std::vector<SharedPoint> read(const Extent& extent) const;
  Extent write(const std::vector<SharedPoint>& points);

  const Bricks& bricks_;
  ScalarType scalar_;
  std::size_t step_;  // bytes of a record
  ClusterOptions options_;
  Execution execution_;
  SpillFile& file_;
  EuclideanClusterer clusterer_;
  PointComponents found_;
  std::vector<Component> components_;
  std::vector<std::uint8_t> shared_;  // for each record, whether other bricks have the point
  std::vector<std::byte> points_of_clusters_, points_of_pieces_;  // buffers
  std::vector<StoredCluster> clusters_;
  std::vector<Piece> pieces_;
  std::vector<Extent> own_, others_;
  Counts counts_;
};

}  // namespace pcl_bv::detail
