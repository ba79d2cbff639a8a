// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns whether the number is 1, 10, 100, ...: repeated warnings are given at these counts.
bool is_power_of_ten(std::uint64_t number);

/// Whether a sensor of a rig sends clouds. A sensor whose clouds are missing in the frames of three of its
/// periods, and of at least 0.3 s, is silent, and frames do not wait for it. Before its second cloud, the
/// time is 1 s. All times are stamps, nanoseconds.
class SensorPresence {
 public:
  /// Notes the time between two successive clouds. The shortest one is the period.
  void note_gap(std::int64_t gap_ns);

  /// Notes whether a frame has a cloud of the sensor. Returns a warning if the sensor becomes silent or sends
  /// again, otherwise an empty text.
  std::string note_frame(bool present, std::int64_t stamp_ns);

  /// Ends the silence when a cloud comes. Returns a warning if the sensor was silent, otherwise an empty
  /// text.
  std::string end_silence(std::int64_t stamp_ns);

  /// Begins anew after stamps that jumped back. The period stays.
  void restart();

  bool silent() const { return silent_; }
  bool in_last_frame() const { return in_last_frame_; }

 private:
  std::optional<std::int64_t> period_ns_;
  std::optional<std::int64_t> last_used_ns_;  // stamp of the last frame with its cloud, or of the first frame
  std::uint64_t silences_ = 0;
  bool in_last_frame_ = true, silent_ = false;
};

}  // namespace detail
}  // namespace pcl_bv
