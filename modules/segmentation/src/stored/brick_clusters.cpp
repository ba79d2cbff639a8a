// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "brick_clusters.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {
namespace {

PointView view_of_records(const std::vector<std::byte>& records, std::size_t step, ScalarType scalar) {
  PointView view;
  view.data = records.data();
  view.stride = view.readable = step;
  view.count = records.size() / step;
  view.scalar = scalar;
  return view;
}

}  // namespace

BrickClusterer::BrickClusterer(const Bricks& bricks, ScalarType scalar, const ClusterOptions& options,
                               const Execution& execution, SpillFile& file)
    : bricks_(bricks),
      scalar_(scalar),
      step_(record_bytes(scalar)),
      options_(options),
      execution_(execution),
      file_(file) {}

std::uint64_t BrickClusterer::number_at(const std::byte* record) const {
  std::uint64_t number;
  std::memcpy(&number, record + step_ - sizeof number, sizeof number);
  return number;
}

void BrickClusterer::add(std::uint32_t brick, const std::vector<std::byte>& records) {
  ComponentAccess::find(clusterer_, view_of_records(records, step_, scalar_), options_, execution_.parallel,
                        found_);
  measure(records);
  make_pieces();
  write_shared(brick, records);
  write_points(records);
}

// Counts the points of each component that belong to the brick, and finds the components that are shared.
void BrickClusterer::measure(const std::vector<std::byte>& records) {
  const PointView view = view_of_records(records, step_, scalar_);
  components_.assign(view.count + 1, {});
  shared_.assign(view.count, 0);
  for (std::size_t i = 0; i < view.count; ++i) {
    const std::uint64_t number = number_at(view.address(i));
    const bool other = (number & kOfOtherBrick) != 0;
    const bool noise = found_.component[i] == found_.noise;
    if (noise) {
      counts_.noise += other ? 0 : 1;
      continue;
    }
    Component& component = components_[found_.component[i]];
    if (!other) ++component.points;
    if (found_.core[i] == 0) continue;
    shared_[i] = (number & (kOfOtherBrick | kInOtherBricks)) != 0 ? 1 : 0;
    component.shared = component.shared || shared_[i] != 0;
  }
}

// Gives numbers to the pieces. A component without points of this brick needs no piece: the bricks of its
// points find the same links.
void BrickClusterer::make_pieces() {
  for (Component& component : components_) {
    if (component.points == 0 || !component.shared) continue;
    if (pieces_.size() >= std::numeric_limits<std::uint32_t>::max())
      throw std::length_error("too many parts of clusters: use more memory");
    component.piece = static_cast<std::uint32_t>(pieces_.size());
    pieces_.push_back({0, component.points});
  }
}

void BrickClusterer::write_shared(std::uint32_t brick, const std::vector<std::byte>& records) {
  const PointView view = view_of_records(records, step_, scalar_);
  std::vector<SharedPoint> own, others;
  Bricks::Cursor cursor;
  for (std::size_t i = 0; i < view.count; ++i) {
    if (shared_[i] == 0) continue;
    const Component& component = components_[found_.component[i]];
    if (component.points == 0) continue;
    const std::uint64_t number = number_at(view.address(i));
    if ((number & kOfOtherBrick) == 0) {
      own.push_back({number & kNumberMask, component.piece, brick});
    } else {
      others.push_back(
          {number & ~kOfOtherBrick, component.piece, bricks_.place(load_point(view, i), cursor).own});
    }
  }
  std::stable_sort(others.begin(), others.end(),
                   [](const SharedPoint& a, const SharedPoint& b) { return a.owner < b.owner; });
  own_.push_back(write(own));
  others_.push_back(write(others));
}

Extent BrickClusterer::write(const std::vector<SharedPoint>& points) {
  return file_.append(points.data(), points.size() * sizeof(SharedPoint));
}

std::vector<SharedPoint> BrickClusterer::read(const Extent& extent) const {
  std::vector<SharedPoint> points(extent.bytes / sizeof(SharedPoint));
  file_.read(extent.offset, points.data(), extent.bytes);
  return points;
}

// Writes the points of complete clusters of allowed sizes without numbers, and those of pieces as records.
void BrickClusterer::write_points(const std::vector<std::byte>& records) {
  const PointView view = view_of_records(records, step_, scalar_);
  const std::size_t point_bytes = step_ - kNumberBytes, first_cluster = clusters_.size();
  std::uint64_t cluster_bytes = 0, piece_bytes = 0;
  for (Component& component : components_) {
    if (component.shared) {
      component.next = piece_bytes;
      piece_bytes += component.points * step_;
    } else if (is_size_allowed(options_, component.points)) {
      component.next = cluster_bytes;
      cluster_bytes += component.points * point_bytes;
    }
  }
  points_of_clusters_.resize(cluster_bytes);
  points_of_pieces_.resize(piece_bytes);
  for (std::size_t i = 0; i < view.count; ++i) {
    const std::byte* const record = view.address(i);
    if ((number_at(record) & kOfOtherBrick) != 0 || found_.component[i] == found_.noise) continue;
    Component& component = components_[found_.component[i]];
    if (component.shared) {
      std::memcpy(points_of_pieces_.data() + component.next, record, step_);
      component.next += step_;
      continue;
    }
    if (!is_size_allowed(options_, component.points)) {
      count_dropped(options_, 1, component.points, counts_);
      continue;
    }
    if (!component.seen) {
      component.seen = true;
      clusters_.push_back({component.next, component.points, number_at(record) & kNumberMask});
    }
    std::memcpy(points_of_clusters_.data() + component.next, record, point_bytes);
    component.next += point_bytes;
  }
  const std::uint64_t at = file_.append(points_of_clusters_.data(), points_of_clusters_.size()).offset;
  for (std::size_t c = first_cluster; c < clusters_.size(); ++c)
    clusters_[c].offset += at;
  const std::uint64_t pieces_at = file_.append(points_of_pieces_.data(), points_of_pieces_.size()).offset;
  for (const Component& component : components_) {
    if (component.points > 0 && component.shared)
      pieces_[component.piece].offset = pieces_at + component.next - component.points * step_;
  }
}

}  // namespace pcl_bv::detail
