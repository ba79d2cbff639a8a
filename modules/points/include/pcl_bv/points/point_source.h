// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points that are not in memory but, for example, in a file. Fits load the points part by part, once for
// every pass over the points. The sizes of the parts are fixed, so results do not depend on the number of
// threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Number of points per block. A kernel tests for each block as a whole whether the block has an invalid
/// point and whether one of its points can be extreme. A block of pcl::PointXYZ has 16 KiB, so a second pass
/// finds the block in the first-level cache.
inline constexpr std::size_t kBlockPoints = 1024;

/// Number of points per chunk. One call of a kernel processes one chunk, in about 10 us. A chunk of
/// pcl::PointXYZ has 512 KiB, so a second kernel finds the chunk in the second-level cache.
inline constexpr std::size_t kChunkPoints = 32 * kBlockPoints;

/// Returns the number of chunks of a cloud. The last chunk may be shorter than kChunkPoints.
constexpr std::size_t chunk_count(std::size_t points) {
  return (points + kChunkPoints - 1) / kChunkPoints;
}

/// Returns block number `block` of a view. The last block may be shorter than kBlockPoints.
inline PointView block_of(const PointView& points, std::size_t block) {
  const std::size_t begin = block * kBlockPoints;
  return points.slice(begin, std::min(kBlockPoints, points.count - begin));
}

/// Provides the points of views whose member PointView::source points to this object. Loading the same points
/// again must give the same bits.
class PointSource {
 public:
  virtual ~PointSource() = default;

  /// Loads points [first, first + count) and returns a view of them. PointView::index() of this view must be
  /// the index in the source. The view refers to `buffer`, which may be resized, or to memory that lives as
  /// long as the source. `count` is at most kChunkPoints. Called concurrently by several threads, each with
  /// its own buffer. May throw.
  virtual PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const = 0;
};

/// Returns a view of `count` points of a source. Copies no points. For kChunkPoints points or fewer, callers
/// should copy the points into memory instead and use a view of the copy.
inline PointView view_of(const PointSource& source, std::size_t count, ScalarType scalar) {
  PointView view;
  view.source = &source;
  view.count = count;
  view.scalar = scalar;
  return view;
}

/// A part of a view, in memory while this object lives. Copies nothing if the points are in memory already.
class LoadedPoints {
 public:
  /// Loads the visited points [begin, begin + count) of the view. Throws std::out_of_range if the view does
  /// not have these points.
  ///
  /// For a view of a source, `count` must be at most kChunkPoints, and the view must not have indices.
  /// Otherwise throws std::invalid_argument. Also throws std::invalid_argument if the source returns other
  /// points than requested. Exceptions that the source throws are passed on.
  LoadedPoints(const PointView& points, std::size_t begin, std::size_t count) {
    if (begin > points.count || count > points.count - begin)
      throw std::out_of_range("LoadedPoints: the requested points are outside the view");
    if (points.source == nullptr) {
      view_ = points.slice(begin, count);
    } else {
      load(points, begin, count);
    }
  }
  ~LoadedPoints() {
    if (buffer_.capacity() > 0) return_buffer();
  }
  LoadedPoints(const LoadedPoints&) = delete;
  LoadedPoints& operator=(const LoadedPoints&) = delete;

  const PointView& view() const { return view_; }

 private:
  void load(const PointView& points, std::size_t begin, std::size_t count);
  void return_buffer();

  PointView view_;
  std::vector<std::byte> buffer_;
};

/// Loads chunk number `chunk` of the view.
inline LoadedPoints load_chunk(const PointView& points, std::size_t chunk) {
  const std::size_t begin = chunk * kChunkPoints;
  return {points, begin, std::min(kChunkPoints, points.count - begin)};
}

}  // namespace pcl_bv
