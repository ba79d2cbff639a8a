// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "pcl_bv/io/raw_cloud.h"
#include "short_decimal.h"

namespace pcl_bv {

/// A place in a text whose lines are rows of values between blanks. Does not own the text, which must be
/// followed by text_padding readable bytes that begin with an end of line.
class TextRows {
 public:
  explicit TextRows(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

  /// Moves to the next value, over line ends too. False at the end of the text.
  bool find_row() {
    while (at_ != end_ && ends_value(*at_))
      ++at_;
    return at_ != end_;
  }

  /// Moves to the next value of the row. False if it has none.
  bool find_value() {
    while (is_blank(*at_))
      ++at_;
    return *at_ != '\n';
  }

  /// Reads the next values of the row as the elements of one field. Returns how many it found before one that
  /// is missing or no such number, and stays there.
  std::uint32_t read(const PointField& field, std::byte* to);

  /// Moves over the value here, whatever it is.
  void skip_value() { at_ += value().size(); }

  /// The value here.
  std::string_view value() const;

 private:
  const char* at_;
  const char* end_;
};

/// Makes the next field a part of this one, so that both are read at once. False, and nothing is done, if
/// they are not of one type.
bool extend_run(PointField& run, const PointField& next);

}  // namespace pcl_bv
