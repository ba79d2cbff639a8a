// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The input of all kernels, which is a non-owning view that fits every layout of points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "pcl_bv/numeric/coordinates.h"

namespace [[gnu::visibility("default")]] pcl_bv {

enum class ScalarType : std::uint8_t { float32, float64 };

/// Returns the size of a coordinate in bytes.
constexpr std::size_t size_of(ScalarType scalar) {
  return scalar == ScalarType::float64 ? 8 : 4;
}

/// How the coordinates are laid out in memory.
enum class PointOrder : std::uint8_t {
  records,  ///< One record per point, with x, y, z adjacent.
  groups    ///< 64 bytes of x, 64 bytes of y, 64 bytes of z, repeated (see point_groups.h).
};

/// Number of bytes of each coordinate in a group. They hold 16 floats or 8 doubles, and are as long as a
/// cache line and as the widest vector of x86.
inline constexpr std::size_t kGroupBytes = 64;

class PointSource;

/// A read-only view of points, either of all points of an array or of those that an index list selects. The
/// view does not own the memory, which must outlive the view. Kernels and segmentation take points that are
/// in memory; fits and verify() also take points of a PointSource.
///
/// Coordinates x, y, z are of type `scalar`, in metres by convention (any unit works). In records they need
/// no alignment. They may be NaN or infinite. Functions that read the coordinates drop such points.
struct PointView {
  const std::byte* data = nullptr;        ///< Address of x of the first point.
  std::size_t stride = 0;                 ///< Records: bytes from one point's x to the next point's x.
  std::size_t readable = 0;               ///< Records: number of bytes readable from any point's x on.
  std::size_t count = 0;                  ///< Number of visited points; the length of `indices` if it is set.
  const std::int32_t* indices = nullptr;  ///< Index of each visited point, or null for consecutive points.
  std::size_t first = 0;                  ///< Without `indices`: index of the first visited point.
  ScalarType scalar = ScalarType::float32;
  PointOrder order = PointOrder::records;

  /// If set, the points are not in memory but are loaded from this source part by part (point_source.h). Then
  /// `data` and `indices` are null, and address() must not be called.
  const PointSource* source = nullptr;

  /// Returns a view of float or double points (other types do not compile). `xyz` points to x of the first
  /// point; points are `stride` bytes apart, and all `stride` bytes are readable (x is the first member of
  /// the record). Indices are not checked; subset() checks them.
  template <typename T, typename = std::enable_if_t<std::is_same_v<T, float> || std::is_same_v<T, double>>>
  static PointView of(const T* xyz, std::size_t stride, std::size_t count,
                      const std::int32_t* indices = nullptr) {
    PointView view;
    view.data = reinterpret_cast<const std::byte*>(xyz);
    view.stride = view.readable = stride;
    view.count = count;
    view.indices = indices;
    view.scalar = sizeof(T) == 4 ? ScalarType::float32 : ScalarType::float64;
    return view;
  }

  bool empty() const { return count == 0; }

  /// Returns the index, in the cloud, of the i-th visited point.
  std::size_t index(std::size_t i) const {
    return indices ? static_cast<std::size_t>(indices[i]) : first + i;
  }

  /// Returns the address of x of the i-th visited point. y is step() bytes after x, and z is step() bytes
  /// after y.
  const std::byte* address(std::size_t i) const {
    if (order == PointOrder::records) {
      return data + stride * (indices ? static_cast<std::size_t>(indices[i]) : i);
    }
    const std::size_t size = size_of(scalar);
    const std::size_t offset = index(i) * size;
    return data + offset / kGroupBytes * (3 * kGroupBytes) + offset % kGroupBytes;
  }

  /// Returns the number of bytes from a point's x to its y, and from its y to its z.
  std::size_t step() const { return order == PointOrder::records ? size_of(scalar) : kGroupBytes; }

  /// Returns a view of the points of the cloud with these indices, in the order of `indices`, which must
  /// outlive the view. An index is a value of index(). O(size), or O(size + count) for a view with an index
  /// list. Throws std::out_of_range, naming the index, for an index below or above those of this view, and
  /// std::invalid_argument for points of a source, which can only be visited in their order.
  PointView subset(const std::int32_t* selected, std::size_t size) const;
  PointView subset(const std::vector<std::int32_t>& selected) const {
    return subset(selected.data(), selected.size());
  }
  PointView subset(std::vector<std::int32_t>&& selected) const =
      delete;  // the view would outlive the indices

  /// Returns a view of the visited points [begin, begin + n). index() of the returned view is still the index
  /// in the cloud.
  PointView slice(std::size_t begin, std::size_t n) const {
    PointView part = *this;
    part.count = n;
    if (indices) {
      part.indices = indices + begin;
    } else {
      if (data != nullptr && order == PointOrder::records) part.data = data + stride * begin;
      part.first = first + begin;
    }
    return part;
  }
};

/// Lists of point indices, one list after the other. Clusters are such lists.
struct IndexLists {
  std::vector<std::int32_t> indices;    ///< All lists, concatenated.
  std::vector<std::size_t> offsets{0};  ///< Start of each list in `indices`; size() + 1 entries.

  /// Returns the number of lists.
  std::size_t size() const { return offsets.size() - 1; }
  bool empty() const { return size() == 0; }
  /// Returns the number of indices in list i.
  std::size_t list_size(std::size_t i) const { return offsets[i + 1] - offsets[i]; }
  /// Returns the first index of list i.
  const std::int32_t* list(std::size_t i) const { return indices.data() + offsets[i]; }
};

/// Returns one view for each list, of the points of `points` with these indices. The lists must outlive the
/// views. O(points + indices). Throws as PointView::subset().
std::vector<PointView> subsets(const PointView& points, const IndexLists& lists);

/// Returns a view of `count` points whose coordinates x, y, z follow one another without gaps. `first` is the
/// index of the first point in its cloud.
inline PointView packed_points(const std::byte* xyz, ScalarType scalar, std::size_t count,
                               std::size_t first = 0) {
  PointView view;
  view.data = xyz;
  view.stride = view.readable = 3 * size_of(scalar);
  view.count = count;
  view.first = first;
  view.scalar = scalar;
  return view;
}

/// Returns whether both views visit the same memory, or points of the same source, in the same order. If so,
/// they have the same points unless the memory or the source has changed in between.
inline bool same_memory(const PointView& a, const PointView& b) {
  return a.data == b.data && a.stride == b.stride && a.count == b.count && a.indices == b.indices &&
         a.first == b.first && a.scalar == b.scalar && a.order == b.order && a.source == b.source;
}

/// Loads the three coordinates of the i-th visited point. T must be the view's scalar type.
template <typename T>
inline void load_point(const PointView& points, std::size_t i, T (&xyz)[3]) {
  const std::byte* x = points.address(i);
  const std::size_t step = points.step();
  std::memcpy(&xyz[0], x, sizeof(T));
  std::memcpy(&xyz[1], x + step, sizeof(T));
  std::memcpy(&xyz[2], x + 2 * step, sizeof(T));
}

/// Returns the coordinates of the i-th visited point as double, which is exact.
inline Coordinates load_point(const PointView& points, std::size_t i) {
  if (points.scalar == ScalarType::float64) {
    double v[3];
    load_point(points, i, v);
    return {v[0], v[1], v[2]};
  }
  float v[3];
  load_point(points, i, v);
  return {v[0], v[1], v[2]};
}

}  // namespace pcl_bv
