// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A time in a file's name can be written in many ways; one way serves all names of a folder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_bv {

/// How a name writes a time, the surest way first.
enum class TimeKind : std::uint8_t {
  epoch,   ///< Since 1970: 1317384506.25, 1317384506_250000000, or a whole number of s, ms, us or ns.
  date,    ///< 20121214T142259.814212, 2024-03-21T12-59-59.900Z, 2024_03_21_12_59_59
  day,     ///< 12-59-59.900: hours, minutes, seconds
  decimal  ///< 899.011149430: seconds since some beginning
};
inline constexpr TimeKind kTimeKinds[]{TimeKind::epoch, TimeKind::date, TimeKind::day, TimeKind::decimal};

/// A time that stands in a name. What the digits behind the point mean depends on the other names.
struct WrittenTime {
  TimeKind kind = TimeKind::epoch;
  std::int64_t seconds = 0;
  std::string fraction{};
  bool may_count = false;  ///< The fraction comes after a dash: it can also count frames.
};

/// All times in a name without its extension, in their order.
std::vector<WrittenTime> times_in(std::string_view stem);

/// Nanoseconds, of a fraction of a second: "25" is a quarter.
std::int64_t stamp_of(const WrittenTime& time);

/// The stamps of all names, where one way of writing serves them all.
struct NameTimes {
  std::vector<std::int64_t> stamps;  ///< Nanoseconds; -1 for a name without a time.
  bool sort = false;     ///< Names without leading or closing zeros are in no order of their times.
  std::string remark{};  ///< That the times do not ascend; mostly empty.
};

/// Of names in their natural order: the way whose times ascend, if there is one. Fractions of different
/// lengths are decimals (12.5 before 12.75) or whole milli-, micro- or nanoseconds without leading zeros,
/// whichever fits.
NameTimes times_of_names(const std::vector<std::string>& stems);

}  // namespace pcl_bv
