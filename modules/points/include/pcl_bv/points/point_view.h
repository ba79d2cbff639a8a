// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The one way in which points enter the kernels: a non-owning view that every point layout fits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "pcl_bv/numeric/coordinates.h"

namespace [[gnu::visibility("default")]] pcl_bv {

enum class ScalarType : std::uint8_t { float32, float64 };

constexpr std::size_t size_of(ScalarType scalar) {
  return scalar == ScalarType::float64 ? 8 : 4;
}

/// How the coordinates lie in memory.
enum class PointOrder : std::uint8_t {
  records,  ///< x, y, z of a point one after another; a record per point.
  groups    ///< The paper's Figure 1: 64 bytes of x, 64 of y, 64 of z, and again (point_groups.h).
};

/// Bytes of each coordinate in a group: 16 floats or 8 doubles, a cache line and the widest vector of x86.
inline constexpr std::size_t kGroupBytes = 64;

class PointSource;

/// A read-only view of points, whole or by an index list. Does not own; the memory must outlive it. Kernels
/// and segmenters take points that are in memory; fits and verify() also those of a PointSource.
///
/// Coordinates x, y, z (metres by convention, any unit works) of type `scalar`; in records they need no
/// alignment. They may be NaN or infinite: such points are dropped by whoever reads them.
struct PointView {
  const std::byte* data = nullptr;        ///< x of the first point.
  std::size_t stride = 0;                 ///< Records: bytes from one point's x to the next one's.
  std::size_t readable = 0;               ///< Records: bytes that may be read from any point's x on.
  std::size_t count = 0;                  ///< Points visited: the length of `indices` if there is one.
  const std::int32_t* indices = nullptr;  ///< Point number of each visited point, or null for 0, 1, 2, ...
  std::size_t first = 0;                  ///< Without indices: number of the first visited point.
  ScalarType scalar = ScalarType::float32;
  PointOrder order = PointOrder::records;

  /// If set, the points are not in memory but come from there part by part (point_source.h): there are no
  /// data and no indices, and address() may not be asked.
  const PointSource* source = nullptr;

  /// Points of float or double (nothing else compiles) whose x is at `xyz`, `stride` bytes apart, with all of
  /// `stride` readable (x comes first in the record). select_points() (point_records.h) checks indices.
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

  /// Number, in the cloud, of the i-th visited point.
  std::size_t index(std::size_t i) const {
    return indices ? static_cast<std::size_t>(indices[i]) : first + i;
  }

  /// Address of x of the i-th visited point; y and z follow after step() bytes each.
  const std::byte* address(std::size_t i) const {
    if (order == PointOrder::records) {
      return data + stride * (indices ? static_cast<std::size_t>(indices[i]) : i);
    }
    const std::size_t size = size_of(scalar);
    const std::size_t offset = index(i) * size;
    return data + offset / kGroupBytes * (3 * kGroupBytes) + offset % kGroupBytes;
  }

  /// Bytes from a point's x to its y, and to its z from there.
  std::size_t step() const { return order == PointOrder::records ? size_of(scalar) : kGroupBytes; }

  /// Visited points [begin, begin + n) as a view of their own; index() still names the cloud's points.
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

/// `count` points, from number `first` of their cloud on, whose coordinates x, y, z lie without gaps.
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

/// Whether both visit the same memory, or points of the same source, in the same order: so they are the same
/// points, unless what is there has changed.
inline bool same_places(const PointView& a, const PointView& b) {
  return a.data == b.data && a.stride == b.stride && a.count == b.count && a.indices == b.indices &&
         a.first == b.first && a.scalar == b.scalar && a.order == b.order && a.source == b.source;
}

/// The three coordinates of the i-th visited point; T is the view's scalar type.
template <typename T>
inline void load_point(const PointView& points, std::size_t i, T (&xyz)[3]) {
  const std::byte* x = points.address(i);
  const std::size_t step = points.step();
  std::memcpy(&xyz[0], x, sizeof(T));
  std::memcpy(&xyz[1], x + step, sizeof(T));
  std::memcpy(&xyz[2], x + 2 * step, sizeof(T));
}

/// Coordinates of the i-th visited point as double (exact).
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
