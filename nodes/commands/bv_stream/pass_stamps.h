// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Stamps of a repeated source (--loop).
#pragma once

#include <algorithm>
#include <cstdint>

#include "pcl_bv/nodes/frame.h"

namespace pcl_bv::detail {

/// Makes the stamps of the passes over a source ascend. Sources whose stamps are those of files or messages
/// give the same stamps in each pass.
class PassStamps {
 public:
  /// Moves the stamp of a frame of a later pass. The first stamp of a pass comes one mean step after the last
  /// stamp of the pass before. Stamps that ascend already, and those that would overflow, stay.
  void move(Frame& frame) {
    const std::int64_t stamp = frame.header.stamp_ns;
    if (frame.pass != pass_) begin_pass(frame.pass, stamp);
    std::int64_t moved = 0;
    if (__builtin_add_overflow(stamp, shift_, &moved)) moved = stamp;
    frame.stamp_shift_ns = moved - stamp;
    frame.header.stamp_ns = moved;
    first_ = count_ > 0 ? std::min(first_, moved) : moved;
    last_ = count_ > 0 ? std::max(last_, moved) : moved;
    ++count_;
  }

  /// Moves the stamp of a frame that could not be read. Its clock may be another one, so later stamps do not
  /// depend on it.
  void move_unreadable(Frame& frame) const {
    std::int64_t moved = 0;
    if (frame.pass == pass_ && frame.header.stamp_ns >= 0 &&
        !__builtin_add_overflow(frame.header.stamp_ns, shift_, &moved))
      frame.header.stamp_ns = moved;
  }

 private:
  void begin_pass(std::uint64_t pass, std::int64_t stamp) {
    std::int64_t span = 0, shift = 0;
    if (count_ > 0 && stamp <= last_ && !__builtin_sub_overflow(last_, first_, &span) &&
        !__builtin_sub_overflow(last_, stamp, &shift)) {
      const std::int64_t step = count_ > 1 ? std::max<std::int64_t>(span / (count_ - 1), 1) : kStep;
      if (!__builtin_add_overflow(shift, step, &shift)) shift_ = shift;
    }
    pass_ = pass;
    count_ = 0;
  }

  static constexpr std::int64_t kStep = 100'000'000;  // after a pass of a single frame, nanoseconds

  std::uint64_t pass_ = 0;
  std::int64_t shift_ = 0, count_ = 0;  // count_: stamps of this pass so far
  std::int64_t first_ = 0, last_ = 0;   // smallest and largest moved stamp of this pass
};

}  // namespace pcl_bv::detail
