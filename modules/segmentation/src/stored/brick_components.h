// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the components of a brick.
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
  std::uint32_t piece;  ///< Number of the piece in its brick.
  std::uint32_t owner;  ///< The brick to which the point belongs.
};

/// The shared points of a brick in the temporary file.
struct SharedPoints {
  Extent own;     ///< Those that belong to the brick, by ascending number.
  Extent others;  ///< Those that belong to other bricks, by owner and ascending number.
};

/// Which components of bricks become pieces, which can be joined with others.
enum class PieceRule {
  shared,  ///< Those with a core point that two bricks have.
  all
};

/// Finds the components of one brick after another. A piece is the part of a cluster that belongs to a brick.
class BrickComponents {
 public:
  static constexpr std::uint32_t kNoPiece = ~std::uint32_t{0};
  static constexpr std::uint32_t kNoise = ~std::uint32_t{0};

  struct Component {
    std::uint64_t points = 0;        ///< Points that belong to the brick.
    std::uint32_t piece = kNoPiece;  ///< Number of the piece in the brick.
    bool shared = false;             ///< Whether it has a core point that two bricks have.
  };

  BrickComponents(const Bricks& bricks, ScalarType scalar, const ClusterOptions& options, PieceRule rule,
                  const Execution& execution, SpillFile& file);

  ScalarType scalar() const { return scalar_; }

  /// Finds the components of a brick with records of `step` bytes, in the order of their numbers. Writes the
  /// shared points. All results are about this brick until the next call.
  void find(std::uint32_t brick, const std::vector<std::byte>& records, std::size_t step);

  /// Returns the components. Some have no points.
  const std::vector<Component>& components() const { return components_; }
  std::uint32_t piece_count() const { return pieces_; }
  /// Returns the component of a record; kNoise for noise.
  std::uint32_t component_of(std::size_t record) const {
    return found_.component[record] == found_.noise ? kNoise : found_.component[record];
  }
  /// Returns whether a record is known to be a core point. Of a record that belongs to another brick this is
  /// not always known.
  bool is_core(std::size_t record) const { return found_.core[record] != 0; }
  std::uint64_t noise_points() const { return noise_points_; }
  const SharedPoints& shared_points() const { return shared_points_; }

 private:
  void measure(const PointView& records);
  void number_pieces();
  void write_shared(std::uint32_t brick, const PointView& records);
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
  SharedPoints shared_points_;
  std::uint32_t pieces_ = 0;
  std::uint64_t noise_points_ = 0;
};

}  // namespace pcl_bv::detail
