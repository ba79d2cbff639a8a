// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the components of bricks one after another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bricks.h"
#include "components.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/segmentation/clusters.h"
#include "record.h"
#include "spill_file.h"

namespace pcl_bv::detail {

/// A core point that two bricks have, and its piece in one of them.
struct SharedPoint {
  std::uint64_t number;
  std::uint32_t piece;
  std::uint32_t owner;  ///< The brick to which the point belongs.
};

/// Which components of bricks become pieces, which can be joined with others.
enum class PieceRule {
  shared,  ///< Those with a core point that two bricks have.
  all
};

/// A piece is the part of a cluster that belongs to one brick.
class BrickComponents {
 public:
  static constexpr std::uint32_t kNoPiece = ~std::uint32_t{0};

  /// A component of the brick that was added last.
  struct Component {
    std::uint64_t points = 0;        ///< Points that belong to the brick.
    std::uint32_t piece = kNoPiece;  ///< Number of the piece, counted over all bricks.
    bool shared = false;             ///< Whether it has a core point that two bricks have.
  };

  BrickComponents(const Bricks& bricks, ScalarType scalar, const ClusterOptions& options, PieceRule rule,
                  const Execution& execution, SpillFile& file);

  ScalarType scalar() const { return scalar_; }

  /// Adds a brick with its records, each of `step` bytes. Bricks must come in ascending order, and the
  /// records of a brick in the order of their numbers.
  void add(std::uint32_t brick, const std::vector<std::byte>& records, std::size_t step);

  // About the brick that was added last.

  /// Returns the components. Some have no points.
  const std::vector<Component>& components() const { return components_; }
  /// Returns the component of a record; kNoise for noise.
  std::uint32_t component_of(std::size_t record) const {
    return found_.component[record] == found_.noise ? kNoise : found_.component[record];
  }
  static constexpr std::uint32_t kNoise = ~std::uint32_t{0};
  /// Returns whether a record is known to be a core point. Of a record that belongs to another brick this is
  /// not always known.
  bool is_core(std::size_t record) const { return found_.core[record] != 0; }

  // About all bricks.

  std::size_t brick_count() const { return own_.size(); }
  std::uint32_t piece_count() const { return pieces_; }
  std::uint64_t noise_points() const { return noise_points_; }

  /// Returns the shared points of a brick that belong to it, by ascending number.
  std::vector<SharedPoint> own_points(std::uint32_t brick) const { return read(own_[brick]); }
  /// Returns the shared points of a brick that belong to other bricks, by owner and ascending number.
  std::vector<SharedPoint> other_points(std::uint32_t brick) const { return read(others_[brick]); }

 private:
  void measure(const PointView& records);
  void number_pieces(PieceRule rule);
  void write_shared(std::uint32_t brick, const PointView& records);
  std::vector<SharedPoint> read(const Extent& extent) const;
  Extent write(const std::vector<SharedPoint>& points);

  const Bricks& bricks_;
  ScalarType scalar_;
  ClusterOptions options_;
  PieceRule rule_;
  Execution execution_;
  SpillFile& file_;
  EuclideanClusterer clusterer_;
  PointComponents found_;
  std::vector<Component> components_;
  std::vector<std::uint8_t> shared_;  // for each record, whether other bricks have the point
  std::vector<Extent> own_, others_;
  std::uint32_t pieces_ = 0;
  std::uint64_t noise_points_ = 0;
};

}  // namespace pcl_bv::detail
