// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The input of all functions: a non-owning view that fits every layout of points. view() makes such a view
// from a vector of points of any type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>
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

/// Number of bytes of each coordinate in a group. These bytes hold 16 floats or 8 doubles. A cache line and
/// the widest vector of x86 have the same size.
inline constexpr std::size_t kGroupBytes = 64;

class PointSource;

/// A read-only view of points, either of consecutive points of an array or of the points that an index list
/// selects. The view does not own the memory, which must outlive the view. Fits, verify(),
/// cloud_statistics(), masks, VolumeTree::first_containing(), pictures and points_vtp() also take points of a
/// PointSource. All other functions take points in memory.
///
/// Coordinates x, y, z are of type `scalar`, in metres by convention (any unit works). In records,
/// coordinates need no alignment. Coordinates may be NaN or infinite. Functions that read the coordinates
/// drop such points.
struct PointView {
  const std::byte* data = nullptr;        ///< Address of x of the first point.
  std::size_t stride = 0;                 ///< Records: bytes from one point's x to the next point's x.
  std::size_t readable = 0;               ///< Records: number of bytes readable from any point's x on.
  std::size_t count = 0;                  ///< Number of visited points; the length of `indices` if not null.
  const std::int32_t* indices = nullptr;  ///< Index of each visited point, or null for consecutive points.
  std::size_t first = 0;                  ///< Without `indices`: index of the first visited point.
  ScalarType scalar = ScalarType::float32;
  PointOrder order = PointOrder::records;

  /// If set, the points are not in memory but are loaded from this source part by part (point_source.h). Then
  /// `data` and `indices` are null, and address() must not be called.
  const PointSource* source = nullptr;

  /// Returns a view of float or double points (other types do not compile). `xyz` points to x of the first
  /// point; points are `stride` bytes apart. From each x on, `stride` bytes must be readable, which is true
  /// if x is the first member of the record. Indices are not checked; subset() checks them.
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

  /// Returns a view of the points with the indices `selected`, in the order of `selected`. The indices are
  /// those in the cloud, as index() returns them, not positions in this view. `selected` must outlive the
  /// view. O(size), or O(size + count) for a view with an index list. Throws std::out_of_range, with the
  /// index in the message, if an index is below the smallest or above the largest index of this view. Throws
  /// std::invalid_argument for a view of a source, because the points of a source can only be visited in
  /// their order.
  PointView subset(const std::int32_t* selected, std::size_t size) const;
  PointView subset(const std::vector<std::int32_t>& selected) const {
    return subset(selected.data(), selected.size());
  }
  PointView subset(std::vector<std::int32_t>&& selected) const =
      delete;  // the view would outlive the indices

  /// Returns a view of the visited points [begin, begin + n). Does not check that the view has these points.
  /// index() of the returned view is still the index in the cloud.
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
  /// Returns a pointer to the indices of list i.
  const std::int32_t* list(std::size_t i) const { return indices.data() + offsets[i]; }
};

/// Returns one view for each list. A view has those points of `points` whose indices are in its list. The
/// lists must outlive the views. O(points + indices). Throws like PointView::subset().
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
/// both views have the same points unless the memory or the source has changed in between.
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

/// A point of a cloud and its squared distance from a query point. The squared distance is (dx dx + dy dy) +
/// dz dz, where d is the point minus the query point. Each step is rounded to double.
struct Neighbor {
  std::int32_t index;
  double squared_distance;
};

/// Orders neighbours by distance. Neighbours at equal distances are ordered by index.
inline bool operator<(const Neighbor& a, const Neighbor& b) {
  return a.squared_distance < b.squared_distance ||
         (a.squared_distance == b.squared_distance && a.index < b.index);
}

/// Whether a struct has members x, y, z, all float or all double.
template <typename Record, typename = void>
struct has_xyz : std::false_type {};
template <typename Record>
struct has_xyz<Record, std::void_t<decltype(Record::x), decltype(Record::y), decltype(Record::z)>> {
  using Scalar = std::remove_cv_t<decltype(Record::x)>;
  static constexpr bool one_type = std::is_same_v<Scalar, std::remove_cv_t<decltype(Record::y)>> &&
                                   std::is_same_v<Scalar, std::remove_cv_t<decltype(Record::z)>>;
  static constexpr bool value = one_type && (std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>);
};

/// Returns a view of all `count` records. Record is any struct with members x, y, z, all float or all double,
/// adjacent in memory in this order. Throws std::invalid_argument if these members are not adjacent.
template <typename Record>
PointView view_records(const Record* records, std::size_t count) {
  static_assert(has_xyz<Record>::value,
                "the point type must have members x, y and z, all float or all double");
  if (count == 0) return {};
  if (&records->y != &records->x + 1 || &records->z != &records->x + 2) {
    throw std::invalid_argument("the members x, y, z of the point type must be adjacent in this order");
  }
  PointView view = PointView::of(&records->x, sizeof(Record), count);
  view.readable -= static_cast<std::size_t>(view.data - reinterpret_cast<const std::byte*>(records));
  return view;
}

namespace detail {
/// Whether a type has elements at data(), such as Eigen::Vector3f.
template <typename Record, typename = void>
struct has_data : std::false_type {};
template <typename Record>
struct has_data<Record, std::void_t<decltype(*std::declval<const Record&>().data())>> : std::true_type {};
}  // namespace detail

/// Returns a view of a vector of points. A point is either a struct that view_records() takes, or a
/// fixed-size array of float or double whose first three elements are x, y, z. Such arrays are
/// Eigen::Vector3f, Eigen::Vector4d or std::array<float, 3>, for example. The vector must outlive the view.
template <typename Record, typename Allocator>
PointView view(const std::vector<Record, Allocator>& points) {
  constexpr bool is_array = detail::has_data<Record>::value;
  static_assert(has_xyz<Record>::value || is_array,
                "the point type must have public members x, y and z, all float or all double, or be an array "
                "such as Eigen::Vector3f or std::array<double, 3>");
  if constexpr (has_xyz<Record>::value) {
    return view_records(points.data(), points.size());
  } else if constexpr (is_array) {
    using Scalar = std::remove_cv_t<std::remove_pointer_t<decltype(std::declval<const Record&>().data())>>;
    static_assert(std::is_trivially_destructible_v<Record> && sizeof(Record) >= 3 * sizeof(Scalar),
                  "the point type must hold at least three coordinates itself");
    if (points.empty()) return {};
    return PointView::of(points.data()->data(), sizeof(Record), points.size());
  } else {
    return {};
  }
}
template <typename Record, typename Allocator>
PointView view(const std::vector<Record, Allocator>&& points) = delete;  // the view would outlive the points

}  // namespace pcl_bv
