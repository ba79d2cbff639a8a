// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Interprets the times in the file names of a folder.

#include <algorithm>
#include <functional>

#include "name_times.h"
#include "pcl_bv/nodes/frame_source.h"

namespace pcl_bv {
using namespace detail;
namespace {

using Times = std::vector<ParsedTime>;

constexpr std::int64_t kDay = 86'400'000'000'000;

bool ascend(const std::vector<std::int64_t>& stamps) {
  return std::adjacent_find(stamps.begin(), stamps.end(), std::greater_equal<>()) == stamps.end();
}

std::vector<std::int64_t> decimal_stamps(const Times& times) {
  std::vector<std::int64_t> stamps(times.size());
  std::transform(times.begin(), times.end(), stamps.begin(), stamp_of);
  return stamps;
}

// Reads fractions as whole milli-, micro- or nanoseconds. The longest fraction decides the unit.
std::vector<std::int64_t> unpadded_stamps(Times times) {
  std::size_t longest = 0;
  for (const ParsedTime& time : times)
    longest = std::max(longest, time.fraction.size());
  longest = (longest + 2) / 3 * 3;
  for (ParsedTime& time : times)
    time.fraction.insert(0, longest - time.fraction.size(), '0');
  return decimal_stamps(times);
}

// Returns the longest time step divided by the median step. The ratio is near 1 for sensors, because their
// steps are even.
double unevenness(std::vector<std::int64_t> stamps) {
  std::sort(stamps.begin(), stamps.end());
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    steps.push_back(stamps[i] - stamps[i - 1]);
  std::sort(steps.begin(), steps.end());
  return static_cast<double>(steps.back()) / std::max(1.0, static_cast<double>(steps[steps.size() / 2]));
}

// Returns whether fractions are whole numbers without leading zeros, not decimals. The first rule that
// applies decides:
// - false, if all fractions have the same length or a fraction has more than 9 digits;
// - false, if a fraction begins with a zero, because whole numbers have no leading zeros;
// - true, if a fraction ends with a zero, because decimals of different lengths have no trailing zeros;
// - otherwise, the reading with the more even time steps is chosen.
bool are_unpadded(const Times& times) {
  const auto any = [&](auto holds) { return std::any_of(times.begin(), times.end(), holds); };
  const std::size_t size = times.front().fraction.size();
  if (!any([&](const ParsedTime& time) { return time.fraction.size() != size; })) return false;
  if (any([](const ParsedTime& time) { return time.fraction.size() > 9; })) return false;
  const auto zero = [](const ParsedTime& time, bool first) {
    const std::string& text = time.fraction;
    return text.size() > 1 && (first ? text.front() : text.back()) == '0';
  };
  if (any([&](const ParsedTime& time) { return zero(time, true); })) return false;
  if (any([&](const ParsedTime& time) { return zero(time, false); })) return true;
  const double unpadded = unevenness(unpadded_stamps(times)), decimal = unevenness(decimal_stamps(times));
  const bool nine = any([](const ParsedTime& time) { return time.fraction.size() == 9; });
  return unpadded < decimal || (unpadded == decimal && nine);
}

// Returns whether fractions are frame numbers. For example, 20121214_142259_000017 is the start time of a
// recording and a frame number.
bool are_frame_numbers(const Times& times) {
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (!times[i].may_be_frame_number || times[i].seconds != times[0].seconds ||
        !times[i - 1].may_be_frame_number ||
        std::stoll(times[i].fraction) != std::stoll(times[i - 1].fraction) + 1)
      return false;
  }
  return times.size() > 1;
}

NameTimes interpretation_of(const Times& times) {
  NameTimes interpretation;
  const bool unpadded = are_unpadded(times);
  interpretation.stamps = unpadded ? unpadded_stamps(times) : decimal_stamps(times);
  if (times.front().kind == TimeKind::time_of_day) {
    std::int64_t days = 0;
    for (std::size_t i = 1; i < interpretation.stamps.size(); ++i) {
      if (interpretation.stamps[i] + days < interpretation.stamps[i - 1] - kDay / 2) days += kDay;
      interpretation.stamps[i] += days;
    }
  }
  const auto other_length = [&](const ParsedTime& time) {
    return time.fraction.size() != times.front().fraction.size();
  };
  interpretation.sort =
      !unpadded && !ascend(interpretation.stamps) && std::any_of(times.begin(), times.end(), other_length);
  return interpretation;
}

// Returns the last time of this kind in each name or, if `last` is false, the first. Returns an empty list if
// a name has no such time.
Times times_of_kind(const std::vector<Times>& all, TimeKind kind, bool last) {
  Times times;
  const auto is_kind = [kind](const ParsedTime& time) { return time.kind == kind; };
  for (const Times& some : all) {
    const auto front = std::find_if(some.begin(), some.end(), is_kind);
    if (front == some.end()) return {};
    times.push_back(last ? *std::find_if(some.rbegin(), some.rend(), is_kind) : *front);
  }
  return times;
}

std::string order_warning(const std::vector<std::int64_t>& stamps, const std::vector<std::string>& stems) {
  std::size_t first = 0, wrong = 0;
  std::int64_t before = -1;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    if (stamps[i] < 0) continue;
    if (before >= 0 && stamps[i] <= before && wrong++ == 0) first = i;
    before = stamps[i];
  }
  if (wrong == 0) return {};
  return "the times in the names do not ascend in the order of the names: '" + stems[first] +
         "' is not later than the one before, " + std::to_string(wrong) + " of " +
         std::to_string(stems.size()) + " are not";
}

}  // namespace

NameTimes detail::times_of_names(const std::vector<std::string>& stems) {
  std::vector<Times> all;
  all.reserve(stems.size());
  for (const std::string& stem : stems)
    all.push_back(times_in(stem));
  std::optional<NameTimes> found;
  for (const TimeKind kind : kTimeKinds) {
    for (const bool last : {true, false}) {
      Times times = times_of_kind(all, kind, last);
      if (times.empty()) continue;
      if (are_frame_numbers(times)) {
        for (ParsedTime& time : times)
          time.fraction.clear();
      }
      NameTimes interpretation = interpretation_of(times);
      if (ascend(interpretation.stamps)) return interpretation;
      if (!found || (interpretation.sort && !found->sort)) found = std::move(interpretation);
    }
  }
  if (!found) {
    found.emplace();
    for (const std::string& stem : stems)
      found->stamps.push_back(stamp_in_name(stem));
  }
  if (!found->sort) found->warning = order_warning(found->stamps, stems);
  return *std::move(found);
}

std::int64_t stamp_in_name(std::string_view stem) {
  const std::vector<Times> one{times_in(stem)};
  for (const TimeKind kind : kTimeKinds) {
    if (const Times times = times_of_kind(one, kind, true); !times.empty()) return stamp_of(times.front());
  }
  return -1;
}

}  // namespace pcl_bv
