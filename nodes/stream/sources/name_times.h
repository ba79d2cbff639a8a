// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Times and numbers in file names. Names use many formats, but one format must fit all names of a folder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_bv::detail {

/// The format of a time in a name, the most reliable format first.
enum class TimeKind : std::uint8_t {
  epoch,        ///< Since 1970: 1317384506.25, 1317384506_250000000, or a whole number of s, ms, us or ns.
  date,         ///< 20121214T142259.814212, 2024-03-21T12-59-59.900Z, 2024_03_21_12_59_59
  time_of_day,  ///< 12-59-59.900: hours, minutes, seconds
  decimal       ///< 899.011149430: seconds since an unknown start
};
inline constexpr TimeKind kTimeKinds[]{TimeKind::epoch, TimeKind::date, TimeKind::time_of_day,
                                       TimeKind::decimal};

/// A time in a name. The meaning of its fraction depends on the other names of the folder.
struct ParsedTime {
  TimeKind kind = TimeKind::epoch;
  std::int64_t seconds = 0;
  std::string fraction{};
  /// Whether the fraction follows a dash or underscore, so that it may be a frame number instead.
  bool may_be_frame_number = false;
};

/// Returns all times in a name without its extension, in order.
std::vector<ParsedTime> times_in(std::string_view stem);

/// Returns the time in nanoseconds. The fraction is decimal, so "25" is a quarter of a second.
std::int64_t stamp_of(const ParsedTime& time);

/// The stamps of all names of a folder, read in one format.
struct NameTimes {
  std::vector<std::int64_t> stamps;  ///< Nanoseconds; -1 for a name without a time.
  bool sort = false;                 ///< Whether the files must be sorted by time, not by name.
  std::string warning{};             ///< Warning about the order of the times; usually empty.
};

/// Returns the stamps of names, which are given in natural order. Prefers a format whose times ascend.
/// Fractions are usually decimals: 12.5 means 12.500 s. If fractions have different lengths, they may also be
/// whole milli-, micro- or nanoseconds without leading zeros: 12.5 then means 12.005 s.
NameTimes times_of_names(const std::vector<std::string>& stems);

/// Returns the number of each name: its only digits, or the only digits that differ between the names.
/// Returns an empty list if a name has none, if a name has a time (stamp_in_name()), or if two names have the
/// same number.
std::vector<std::size_t> numbers_of_names(const std::vector<std::string>& stems);

}  // namespace pcl_bv::detail
