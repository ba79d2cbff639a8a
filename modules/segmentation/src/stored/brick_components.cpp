// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "brick_components.h"

#include <algorithm>

namespace pcl_bv::detail {

BrickComponents::BrickComponents(const Bricks& bricks, ScalarType scalar, const ClusterOptions& options,
                                 PieceRule rule, const Execution& execution, SpillFile& file)
    : bricks_(bricks), scalar_(scalar), options_(options), rule_(rule), execution_(execution), file_(file) {}

void BrickComponents::find(std::uint32_t brick, const std::vector<std::byte>& records, std::size_t step) {
  const PointView view = view_of_records(records, step, scalar_);
  ComponentAccess::find(clusterer_, view, options_, execution_.parallel, found_);
  measure(view);
  number_pieces();
  write_shared(brick, view);
}

// Counts the points of each component that belong to the brick, and finds the components that are shared.
void BrickComponents::measure(const PointView& records) {
  noise_points_ = 0;
  components_.assign(records.count + 1, {});
  shared_.assign(records.count, 0);
  for (std::size_t i = 0; i < records.count; ++i) {
    const std::uint64_t number = number_of_record(records.address(i), scalar_);
    const bool other = (number & kOfOtherBrick) != 0;
    const bool noise = found_.component[i] == found_.noise;
    if (noise) {
      noise_points_ += other ? 0 : 1;
      continue;
    }
    Component& component = components_[found_.component[i]];
    if (!other) ++component.points;
    if (found_.core[i] == 0) continue;
    shared_[i] = (number & (kOfOtherBrick | kInOtherBricks)) != 0 ? 1 : 0;
    component.shared = component.shared || shared_[i] != 0;
  }
}

// A component without points of this brick needs no piece: the bricks of its points find the same links.
void BrickComponents::number_pieces() {
  pieces_ = 0;
  for (Component& component : components_) {
    if (component.points > 0 && (rule_ == PieceRule::all || component.shared)) component.piece = pieces_++;
  }
}

void BrickComponents::write_shared(std::uint32_t brick, const PointView& records) {
  std::vector<SharedPoint> own, others;
  Bricks::Cursor cursor;
  for (std::size_t i = 0; i < records.count; ++i) {
    if (shared_[i] == 0) continue;
    const Component& component = components_[found_.component[i]];
    if (component.points == 0) continue;
    const std::uint64_t number = number_of_record(records.address(i), scalar_);
    if ((number & kOfOtherBrick) == 0) {
      own.push_back({number & kNumberMask, component.piece, brick});
      continue;
    }
    const std::uint32_t owner = bricks_.place(load_point(records, i), cursor).own;
    if (owner != Bricks::kNone) others.push_back({number & kNumberMask, component.piece, owner});
  }
  std::stable_sort(others.begin(), others.end(),
                   [](const SharedPoint& a, const SharedPoint& b) { return a.owner < b.owner; });
  shared_points_ = {write(own), write(others)};
}

Extent BrickComponents::write(const std::vector<SharedPoint>& points) {
  return file_.append(points.data(), points.size() * sizeof(SharedPoint));
}

}  // namespace pcl_bv::detail
