// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds times in file names, in the formats that recorders write.

#include <chrono>

#include "name_times.h"
#include "pipeline/config/names.h"

namespace pcl_bv::detail {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Reads a name from left to right.
class NameReader {
 public:
  NameReader(std::string_view text, std::size_t at) : text_(text), at_(at) {}

  std::size_t at() const { return at_; }
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(std::string_view any) {
    if (here() == '\0' || any.find(here()) == std::string_view::npos) return false;
    ++at_;
    return true;
  }
  std::string_view digits() const {
    std::size_t end = at_;
    while (end < text_.size() && is_digit(text_[end]))
      ++end;
    return text_.substr(at_, end - at_);
  }
  std::string_view take_digits() {
    const std::string_view run = digits();
    at_ += run.size();
    return run;
  }
  // Reads a number of `count` digits. If `alone`, no further digit may follow. Returns -1 if there is no
  // such number.
  int number(std::size_t count, bool alone) {
    const std::string_view run = digits();
    if (run.size() < count || (alone && run.size() > count)) return -1;
    int value = 0;
    for (const char c : run.substr(0, count))
      value = 10 * value + (c - '0');
    at_ += count;
    return value;
  }

 private:
  std::string_view text_;
  std::size_t at_;
};

// Returns the number, or -1 if it is too large.
std::int64_t whole(std::string_view digits) {
  std::int64_t value = 0;
  return read_whole_text(digits, value) ? value : -1;
}

// Reads hours, minutes, seconds and, if there is one, a fraction. If `apart`, the same separator must precede
// the minutes and the seconds (12-59-59). Otherwise there must be no separator. Returns the seconds of the
// day, or -1 if there is no time.
std::int64_t take_clock(NameReader& name, bool apart, ParsedTime& time) {
  const int hours = name.number(2, apart);
  const char between = name.here();
  if (apart && !name.take("-_:.")) return -1;
  const int minutes = name.number(2, apart);
  if (apart && !name.take(std::string_view(&between, 1))) return -1;
  const int seconds = name.number(2, apart);
  if (hours < 0 || hours > 23 || minutes < 0 || minutes > 59 || seconds < 0 || seconds > 60) return -1;
  NameReader behind = name;
  time.fraction = behind.take_digits();  // a fraction that follows the seconds directly
  if (time.fraction.empty() && behind.take(".,")) {
    time.fraction = behind.take_digits();
  } else if (time.fraction.empty() && behind.take("-_")) {
    const std::size_t size = behind.digits().size();
    time.may_be_frame_number = size == 3 || size == 6 || size == 9;
    if (time.may_be_frame_number) time.fraction = behind.take_digits();
  }
  if (!time.fraction.empty()) name = behind;
  return 3600 * hours + 60 * minutes + seconds;
}

// Reads a time zone such as "+0800" or "+08:00". Returns its seconds, or 0 (UTC) for any other text.
std::int64_t take_zone(NameReader& name) {
  NameReader zone = name;
  if (!zone.take("+")) return 0;
  const int hours = zone.number(2, false);
  zone.take(":");
  const int minutes = zone.number(2, true);
  if (hours < 0 || hours > 14 || minutes < 0 || minutes > 59) return 0;
  name = zone;
  return 3600 * hours + 60 * minutes;
}

std::optional<ParsedTime> take_date(NameReader& name) {
  NameReader at = name;
  const std::size_t run = at.digits().size();
  const bool joined =
      run == 14 || run == 17 || run == 20 || run == 23;  // 14 digits and a fraction of 0, 3, 6 or 9 digits
  const bool apart = run == 4;
  if (!joined && !apart && run != 8) return std::nullopt;
  const int year = at.number(4, apart);
  if (apart && !at.take("-_.:")) return std::nullopt;
  const int month = at.number(2, apart);
  if (apart && !at.take("-_.:")) return std::nullopt;
  const int day = at.number(2, !joined);
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (year < 1970 || year > 2261 || month < 0 || day < 0 || !date.ok()) return std::nullopt;
  if (!joined && !at.take("Tt_-. ")) return std::nullopt;
  ParsedTime time{TimeKind::date};
  const std::int64_t clock = take_clock(at, at.digits().size() == 2, time);
  if (clock < 0) return std::nullopt;
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  time.seconds = 86'400 * days + clock - take_zone(at);
  name = at;
  return time;
}

std::optional<ParsedTime> take_clock_time(NameReader& name) {
  NameReader at = name;
  if (NameReader hours = name; hours.number(2, true) < 0 || hours.here() == '.')
    return std::nullopt;  // a decimal number
  ParsedTime time{TimeKind::time_of_day};
  time.seconds = take_clock(at, true, time);
  if (time.seconds < 0) return std::nullopt;
  name = at;
  return time;
}

ParsedTime of_nanoseconds(std::int64_t stamp) {
  const std::string rest = std::to_string(stamp % kSecond);
  return {TimeKind::epoch, stamp / kSecond, std::string(9 - rest.size(), '0') + rest};
}

// Interprets a whole number as a time. Times are seconds of 2001 to 2033, milli- or microseconds of 2001 to
// 2262, and nanoseconds of at least 1e16. 64-bit nanoseconds end in 2262. Other numbers are frame numbers.
std::optional<ParsedTime> epoch_of(std::int64_t value) {
  constexpr std::int64_t e9 = 1'000'000'000, e12 = 1000 * e9, e15 = 1000 * e12;
  if (value >= 10 * e15) return of_nanoseconds(value);
  if (value >= e15 && value <= INT64_MAX / 1000) return of_nanoseconds(1000 * value);
  if (value >= e12 && value <= INT64_MAX / 1'000'000) return of_nanoseconds(1'000'000 * value);
  if (value >= e9 && value < 2 * e9) return ParsedTime{TimeKind::epoch, value};
  return std::nullopt;
}

// Reads a number with or without a decimal point.
std::optional<ParsedTime> take_number(NameReader& name) {
  constexpr std::int64_t since_2001 = 1'000'000'000, max_seconds = INT64_MAX / kSecond - 1;
  const std::int64_t value = whole(name.take_digits());
  NameReader behind = name;
  const bool point = behind.take("."), dash = !point && behind.take("_-");
  const std::size_t digits = behind.digits().size();
  std::optional<ParsedTime> time = epoch_of(value);
  const bool seconds = value >= since_2001 && value < 2 * since_2001;
  if ((point && digits > 0) || (dash && seconds && digits >= 3 && digits <= 9)) {
    time = std::nullopt;
    const TimeKind kind = seconds ? TimeKind::epoch : TimeKind::decimal;
    if (value >= 0 && value <= max_seconds)
      time = ParsedTime{kind, value, std::string(behind.take_digits()), dash};
    if (!time) behind.take_digits();
    name = behind;
  }
  return time;
}

}  // namespace

std::vector<ParsedTime> times_in(std::string_view stem) {
  std::vector<ParsedTime> times;
  for (NameReader name(stem, 0); name.at() < stem.size();) {
    if (!is_digit(name.here())) {
      name = NameReader(stem, name.at() + 1);
      continue;
    }
    std::optional<ParsedTime> time = take_date(name);
    if (!time) time = take_clock_time(name);
    if (!time) time = take_number(name);
    if (time) times.push_back(*std::move(time));
  }
  return times;
}

std::int64_t stamp_of(const ParsedTime& time) {
  std::string nanoseconds = time.fraction.substr(0, 9);
  nanoseconds.append(9 - nanoseconds.size(), '0');
  return time.seconds * kSecond + whole(nanoseconds);
}

}  // namespace pcl_bv::detail
