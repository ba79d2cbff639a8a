// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The one way in which points enter the kernels: a non-owning view that every point layout fits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pcl_bv {

enum class ScalarType : std::uint8_t { float32, float64 };

/// A read-only view of points in memory, whole or by an index list. Does not own; the memory must outlive it.
///
/// Each point is three consecutive coordinates x, y, z (metres by convention, any unit works) of type
/// `scalar`; they need no alignment. Coordinates may be NaN or infinite: such points are dropped by whoever
/// reads them.
struct PointView {
  const std::byte* data = nullptr;        ///< x of point 0.
  std::size_t stride = 0;                 ///< Bytes from one point's x to the next one's; >= 3 scalars.
  std::size_t readable = 0;               ///< Bytes that may be read from any point's x on; >= 3 scalars.
  std::size_t count = 0;                  ///< Points visited: the length of `indices` if there is one.
  const std::int32_t* indices = nullptr;  ///< Point number of each visited point, or null for 0, 1, 2, ...
  std::size_t first = 0;                  ///< Without indices: point number of data[0], after slice().
  ScalarType scalar = ScalarType::float32;

  /// Points whose x is at `xyz`, `stride` bytes apart, with all of `stride` readable (x comes first in the
  /// record).
  template <typename T>
  static PointView of(const T* xyz, std::size_t stride, std::size_t count,
                      const std::int32_t* indices = nullptr) {
    static_assert(sizeof(T) == 4 || sizeof(T) == 8, "coordinates are float or double");
    return {reinterpret_cast<const std::byte*>(xyz),
            stride,
            stride,
            count,
            indices,
            0,
            sizeof(T) == 4 ? ScalarType::float32 : ScalarType::float64};
  }

  bool empty() const { return count == 0; }

  /// Number, in the cloud, of the i-th visited point.
  std::size_t index(std::size_t i) const {
    return indices ? static_cast<std::size_t>(indices[i]) : first + i;
  }

  /// Address of x of the i-th visited point.
  const std::byte* address(std::size_t i) const {
    return data + stride * (indices ? static_cast<std::size_t>(indices[i]) : i);
  }

  /// Visited points [begin, begin + n) as a view of their own; index() still names the cloud's points.
  PointView slice(std::size_t begin, std::size_t n) const {
    PointView part = *this;
    part.count = n;
    if (indices) {
      part.indices = indices + begin;
    } else {
      part.data = data + stride * begin;
      part.first = first + begin;
    }
    return part;
  }
};

/// Coordinates of the i-th visited point as double (exact).
struct Coordinates {
  double x, y, z;
};

inline Coordinates load_point(const PointView& points, std::size_t i) {
  if (points.scalar == ScalarType::float64) {
    double v[3];
    std::memcpy(v, points.address(i), sizeof v);
    return {v[0], v[1], v[2]};
  }
  float v[3];
  std::memcpy(v, points.address(i), sizeof v);
  return {v[0], v[1], v[2]};
}

/// Whether a point counts: all three coordinates finite, and at most 1e100 in magnitude (only a double can
/// exceed that; beyond it squares would leave the range of double).
inline bool is_valid(const Coordinates& p) {
  constexpr double limit = 1e100;
  return p.x >= -limit && p.x <= limit && p.y >= -limit && p.y <= limit && p.z >= -limit && p.z <= limit;
}

}  // namespace pcl_bv
