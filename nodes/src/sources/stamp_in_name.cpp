// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Times as recorders write them into file names.

#include "config/words.h"
#include "pcl_bv/nodes/frame_source.h"

namespace pcl_bv {
namespace {

constexpr std::int64_t kLeastStamp = 1'000'000'000'000'000;  // whole: smaller ones count frames

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// -1 if it is none or too great.
std::int64_t whole(std::string_view digits) {
  std::int64_t value = 0;
  return read_whole_text(digits, value) ? value : -1;
}

}  // namespace

std::int64_t stamp_in_name(std::string_view stem) {
  std::size_t end = stem.size();
  while (end > 0 && !is_digit(stem[end - 1]))
    --end;
  std::size_t begin = end;
  while (begin > 0 && is_digit(stem[begin - 1]))
    --begin;
  const std::string_view last = stem.substr(begin, end - begin);
  std::size_t before = begin;
  if (begin > 0 && stem[begin - 1] == '.') {
    for (--before; before > 0 && is_digit(stem[before - 1]);)
      --before;
  }
  if (before + 1 >= begin) {
    const std::int64_t stamp = whole(last);
    return stamp < kLeastStamp ? -1 : stamp < 10 * kLeastStamp ? 1000 * stamp : stamp;
  }
  std::string nanoseconds(last.substr(0, 9));
  nanoseconds.append(9 - nanoseconds.size(), '0');
  const std::int64_t seconds = whole(stem.substr(before, begin - 1 - before));
  constexpr std::int64_t most = INT64_MAX / 1'000'000'000 - 1;
  return seconds < 0 || seconds > most ? -1 : seconds * 1'000'000'000 + whole(nanoseconds);
}

}  // namespace pcl_bv
