// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Joins the parts of tracked objects.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "pipeline/track/known_object.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A cluster, or a part of a cluster that was cut.
struct ClusterPart {
  std::size_t begin = 0, size = 0;  ///< Range in the list of indices.
  std::size_t cluster = 0;          ///< Number of the cluster before all cuts.
  Refinement refinement = Refinement::none;
  Eigen::AlignedBox3d box;  ///< In the fixed frame. Parts that were cut need none.
};

/// Finds clusters that are parts of one object: they are inside the box of a tracked vehicle.
///
/// A vehicle is a track with an id whose known box is 1.5 m to 6 m long and at most 3.5 m high. Clusters that
/// were cut, and people with a track of their own, are parts of no vehicle.
class PartJoin {
 public:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// Replaces `whole_of` by the number of the piece that each piece is joined to: `none`, or a smaller
  /// number. `class_of` is the class of each cluster, or is empty; pieces of different classes are not
  /// joined. Returns the number of joined objects. `known` is sorted by the x of the centres.
  std::size_t find(const std::vector<ClusterPart>& pieces, const std::vector<KnownObject>& known,
                   const std::vector<std::int64_t>& class_of, std::vector<std::size_t>& whole_of);

 private:
  bool is_part(const ClusterPart& piece, const KnownObject& vehicle,
               const std::vector<KnownObject>& known) const;

  void sort_by_x(const std::vector<ClusterPart>& pieces);
  void find_parts(const std::vector<ClusterPart>& pieces, const KnownObject& vehicle,
                  const std::vector<KnownObject>& known);

  std::vector<const KnownObject*> vehicles_;
  std::vector<std::pair<double, std::size_t>> by_x_;  // x of the centre and number of a piece
  std::vector<char> taken_;
  std::vector<std::size_t> parts_;
};

}  // namespace detail
}  // namespace pcl_bv
