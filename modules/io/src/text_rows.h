// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Rows of numbers as text, for every format that has them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {

/// A place in a text whose lines are rows of values between blanks. Does not own the text.
class TextRows {
 public:
  explicit TextRows(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

  /// Moves to the next value, over line ends too. False at the end of the text.
  bool find_row();

  /// Moves to the next value of the row. False if it has none.
  bool find_value();

  /// Reads the value here as one element of the field. False, without moving, if it is no such number.
  bool read(const PointField& field, std::byte* to);

  /// Moves over the value here, whatever it is.
  void skip_value();

  /// Moves to the end of the row.
  void skip_row();

  /// The value here.
  std::string_view value() const;

 private:
  const char* at_;
  const char* end_;
};

}  // namespace pcl_bv
