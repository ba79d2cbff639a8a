// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "brick_clusters.h"

#include <cstring>

#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {

// Gives each component its range in a buffer: pieces in one, complete clusters of allowed sizes in the other.
void BrickClusters::make_room(std::vector<Piece>& pieces) {
  const auto& all = components_.components();
  const std::size_t step = record_bytes(components_.scalar()), bytes = point_bytes(components_.scalar());
  next_.assign(all.size(), 0);
  seen_.assign(all.size(), 0);
  std::uint64_t cluster_bytes = 0, piece_bytes = 0;
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (all[c].points == 0) continue;
    if (all[c].piece != BrickComponents::kNoPiece) {
      next_[c] = piece_bytes;
      pieces.push_back({piece_bytes, all[c].points});
      piece_bytes += all[c].points * step;
    } else if (is_size_allowed(options_, all[c].points)) {
      next_[c] = cluster_bytes;
      cluster_bytes += all[c].points * bytes;
    }
  }
  points_of_clusters_.resize(cluster_bytes);
  points_of_pieces_.resize(piece_bytes);
}

BrickResult BrickClusters::write(std::uint32_t brick, const std::vector<std::byte>& records,
                                 std::size_t step) {
  BrickResult result;
  result.shared = components_.shared_points();
  result.counts.noise = components_.noise_points();
  const auto& all = components_.components();
  const ScalarType scalar = components_.scalar();
  const std::size_t record_size = record_bytes(scalar), point_size = point_bytes(scalar);
  make_room(result.pieces);
  for (std::size_t i = 0; i * step < records.size(); ++i) {
    const std::byte* const record = records.data() + i * step;
    const std::uint64_t number = number_of_record(record, scalar);
    const std::uint32_t c = components_.component_of(i);
    if ((number & kOfOtherBrick) != 0 || c == BrickComponents::kNoise) continue;
    if (all[c].piece != BrickComponents::kNoPiece) {
      std::memcpy(points_of_pieces_.data() + next_[c], record, record_size);
      next_[c] += record_size;
    } else if (is_size_allowed(options_, all[c].points)) {
      if (seen_[c] == 0) result.clusters.push_back({next_[c], all[c].points, number & kNumberMask});
      seen_[c] = 1;
      std::memcpy(points_of_clusters_.data() + next_[c], record, point_size);
      next_[c] += point_size;
    } else {
      count_dropped(options_, 1, all[c].points, result.counts);
    }
  }
  write_clusters(brick, result.clusters);
  const std::uint64_t at = file_.append(points_of_pieces_.data(), points_of_pieces_.size()).offset;
  for (Piece& piece : result.pieces)
    piece.offset += at;
  return result;
}

void BrickClusters::write_clusters(std::uint32_t brick, std::vector<StoredCluster>& clusters) {
  if (store_.visit && !clusters.empty()) {
    std::vector<PointView> views;
    views.reserve(clusters.size());
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      views.push_back(packed_points(points_of_clusters_.data() + clusters[c].offset, components_.scalar(),
                                    clusters[c].points));
      clusters[c].visit = StoredVisit{brick, c};
    }
    store_.visit(brick, views, execution_);
    if (!store_.keep_visited) return;
  }
  const std::uint64_t at = file_.append(points_of_clusters_.data(), points_of_clusters_.size()).offset;
  for (StoredCluster& cluster : clusters)
    cluster.offset += at;
}

}  // namespace pcl_bv::detail
