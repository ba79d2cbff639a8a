// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Stamps of messages. Some drivers write none.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pcl_bv::detail {

/// The stamps of the messages of one topic. A stamp of 0 is a stamp: a recording or a simulation may begin at
/// 0. But two messages in a row with this stamp come from a driver that writes no stamps, and a stamp of 0
/// behind one of the time of day is none: the stamp is then the time at which the message was sent or
/// recorded.
class MessageStamps {
 public:
  /// Says that the next message with the stamp 0 has none: it is known that the one after it has none, too.
  void expect_none() { zeros_ = 1; }

  /// Returns the stamp of the next message, nanoseconds.
  std::int64_t next(std::int64_t stamp_ns, std::int64_t recorded_ns) {
    if (stamp_ns != 0) {
      zeros_ = 0;
      last_ = stamp_ns;
      return stamp_ns;
    }
    if (last_ > kYear && recorded_ns > kYear) return recorded_ns;
    if (zeros_ < 2) ++zeros_;
    if (zeros_ < 2) return 0;
    if (!std::exchange(warned_, true)) warnings_.emplace_back(kWarning);
    return recorded_ns;
  }

  /// Returns a line if messages without stamps have come, once.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  static constexpr const char* kWarning =
      "the clouds have no stamps (all are 0): their times of sending or recording are used instead";

  static constexpr std::int64_t kYear = 31'536'000'000'000'000;  // nanoseconds

  std::int64_t last_ = 0;  // the last stamp that was not 0
  int zeros_ = 0;          // messages with the stamp 0 since the last other one, at most 2
  bool warned_ = false;
  std::vector<std::string> warnings_;
};

}  // namespace pcl_bv::detail
