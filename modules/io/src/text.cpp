// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "text.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "short_decimal.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Larger exponents are clamped to this value, so that sums cannot overflow. The clamping cannot change a
// result, because no text has 2^62 digits that would compensate the exponent.
constexpr std::int64_t exponent_limit = std::int64_t{1} << 62;

std::int64_t parse_exponent(std::string_view text) {
  std::int64_t exponent = 0;
  if (!read_number(text, exponent) || exponent > exponent_limit || exponent < -exponent_limit) {
    return text.front() == '-' ? -exponent_limit : exponent_limit;
  }
  return exponent;
}

}  // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result(text.substr(0, longest));
  for (char& c : result) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "'" + result + (text.size() > longest ? "...'" : "'");
}

void detail::parse_header(const InputFile& file, const char* last_line,
                          const std::function<bool(std::string_view start, bool more)>& parse) {
  for (std::size_t size = 1 << 16; size <= kMaxHeaderBytes; size *= 4) {
    std::string start(std::min(file.size(), size), '\0');
    file.read(0, start.data(), start.size());
    const bool whole = start.size() == file.size();
    if (parse(start, !whole)) return;
    if (whole)
      throw IoError(std::string("truncated header: no ") + last_line + " in the first " +
                    std::to_string(start.size()) + " bytes");
  }
  throw IoError("header: longer than the " + std::to_string(kMaxHeaderBytes) + " bytes allowed, no " +
                last_line + " in them");
}

Words detail::split(std::string_view line) {
  Words words;
  auto word = std::find_if_not(line.begin(), line.end(), is_blank);
  while (word != line.end()) {
    const auto end = std::find_if(word, line.end(), is_blank);
    words.emplace_back(word, end);
    word = std::find_if_not(end, line.end(), is_blank);
  }
  return words;
}

bool detail::is_word(std::string_view text) {
  return !text.empty() && std::none_of(text.begin(), text.end(), ends_value);
}

// std::from_chars reports "out of range" for a float both for 1e39 and for 1e-46. The sign of the decimal
// exponent distinguishes overflow from underflow, because all values from 1e-45 to 1e38 are in range.
double detail::value_beyond_range(std::string_view number) {
  const bool negative = number.front() == '-';
  if (negative) number.remove_prefix(1);
  std::int64_t exponent = 0;
  if (const std::size_t e = number.find_first_of("eE"); e != std::string_view::npos) {
    exponent = parse_exponent(number.substr(e + 1));
    number = number.substr(0, e);
  }
  const std::size_t point = std::min(number.find('.'), number.size());
  const std::size_t first_digit = number.find_first_of("123456789");
  exponent += static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first_digit);
  const double magnitude = exponent > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return negative ? -magnitude : magnitude;
}

}  // namespace pcl_bv
