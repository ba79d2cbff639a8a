// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The time at which each point of a sweep was measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns whether the point is a return: drivers write (0, 0, 0) or NaN for rays without one.
inline bool has_return(const Coordinates& point) {
  return is_valid(point) && (point.x != 0 || point.y != 0 || point.z != 0);
}

/// Reads the times of points. Drivers write them in seconds, milliseconds, microseconds or nanoseconds, since
/// the stamp, since the start of the sensor, or since 1970.
///
/// - **Unit.** A sweep takes 1 ms to 1 s. The unit is derived from the span of the times. The earliest 10 %
///   and the latest 10 % of the points with a return are ignored.
/// - **Origin.** Times within one second of 0 are relative to the stamp. Times within one second of the stamp
///   are absolute. Otherwise the clocks differ, and the first point gets the time of the stamp.
/// - **Outliers.** Points that are more than one second or four sweeps from the median, or have no finite
///   time, get the time of the stamp.
class PointTimes {
 public:
  /// Writes the times relative to the stamp to `seconds`, one for each point. `points` are the points of the
  /// field's records. Returns what was found. `seconds` is undefined unless DeskewTimes::problem is `none`.
  /// The instruction set does not change the result. The caller must hold a FloatEnvironment. O(points);
  /// allocates only if it needs more memory than before.
  DeskewTimes read(UsableIsa isa, const FieldView& field, const PointView& points, std::int64_t stamp_ns,
                   float* seconds);

 private:
  void sample(const FieldView& field, const PointView& points);
  double ranked(std::size_t rank);

  std::vector<double> sample_;
};

/// Returns whether two points have different times. Equal times are not those of a sweep: all points of a
/// sensor in a merged cloud have the same time if the sensor has no times of a sweep.
bool times_differ(const float* seconds, std::size_t count);

/// Returns a warning if the times are relative to an unknown origin, or if points have no time of the sweep;
/// otherwise an empty text.
std::string times_warning(const DeskewTimes& times);

}  // namespace detail
}  // namespace pcl_bv
