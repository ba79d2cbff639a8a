// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points that stay where they are, a file mostly, and come into memory part by part, as often as a fit passes
// over them.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "pcl_bv/points/chunks.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Where the points of a view with PointView::source come from. Each load of the same points gives the same
/// bits.
class PointSource {
 public:
  virtual ~PointSource() = default;

  /// Brings points [first, first + count) into memory and returns a view of them, whose index() is that in
  /// the source: of `buffer`, which is resized as needed, or of memory that lives as long as the source.
  /// `count` is at most kChunkPoints. Called by several threads at a time, with a buffer each. May throw.
  virtual PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const = 0;
};

/// A view of `count` points of a source. Few of them (kChunkPoints or less) are better held in memory.
inline PointView view_of(const PointSource& source, std::size_t count, ScalarType scalar) {
  PointView view;
  view.source = &source;
  view.count = count;
  view.scalar = scalar;
  return view;
}

/// A part of a view, in memory while this object lives. Costs nothing where it is there already.
class LoadedPoints {
 public:
  /// Visited points [begin, begin + count) of the view, at most kChunkPoints if it has a source. Throws
  /// std::out_of_range for points that the view does not have, and for those of a source what it throws and
  /// std::invalid_argument for more points, for a view that has indices, too, and for a source that gives
  /// other points than it was asked for.
  LoadedPoints(const PointView& points, std::size_t begin, std::size_t count) {
    if (begin > points.count || count > points.count - begin)
      throw std::out_of_range("LoadedPoints: the view does not have these points");
    if (points.source == nullptr) {
      view_ = points.slice(begin, count);
    } else {
      load(points, begin, count);
    }
  }
  ~LoadedPoints() {
    if (buffer_.capacity() > 0) give_back();
  }
  LoadedPoints(const LoadedPoints&) = delete;
  LoadedPoints& operator=(const LoadedPoints&) = delete;

  const PointView& view() const { return view_; }

 private:
  void load(const PointView& points, std::size_t begin, std::size_t count);
  void give_back();

  PointView view_;
  std::vector<std::byte> buffer_;
};

/// Chunk number `chunk` of the view.
inline LoadedPoints load_chunk(const PointView& points, std::size_t chunk) {
  const std::size_t begin = chunk * kChunkPoints;
  return {points, begin, std::min(kChunkPoints, points.count - begin)};
}

}  // namespace pcl_bv
