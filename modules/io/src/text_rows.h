// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of text rows, read in pieces by several threads; what comes out is as if one had read them in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/policy.h"
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
  /// is missing or no such number, and stays there. Whole numbers are integers however they are written (1.0,
  /// 1e3).
  std::uint32_t read(const PointField& field, std::byte* to);

  /// The same for all its elements: calls stuck(number of the element, where it goes) where one is missing or
  /// no such number. That throws, or moves over the value and puts another in its place.
  template <typename Stuck>
  void read_all(const PointField& field, std::byte* to, const Stuck& stuck) {
    std::uint32_t found = read(field, to);
    while (found < field.count) {
      stuck(found, to + std::size_t{found} * field.size);
      PointField rest = field;
      rest.count -= ++found;
      found += read(rest, to + std::size_t{found} * field.size);
    }
  }

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

/// With the records made of it, such a piece stays in the second-level cache.
inline constexpr std::size_t default_text_piece = 256 << 10;

/// Where rows begin in a file, and what ends them.
struct TextBody {
  const InputFile& file;
  std::size_t begin;
  bool returns_end_rows;                         ///< A carriage return alone ends a row too.
  std::size_t piece_bytes = default_text_piece;  ///< Of the text at a time.
};

/// A row that cannot be read. What it says goes around the number of the row.
struct RowError {
  std::string before, after;
};

/// Rows wanted: the number of the first one in messages, how many, and how many bytes they become.
struct RowsWanted {
  std::size_t first_number;
  std::size_t count;
  std::size_t record_bytes;
};

/// Reads the row that begins here into the record, and moves to its end. Throws RowError.
using ReadRow = std::function<void(TextRows& rows, std::byte* record)>;

struct RowsRead {
  std::size_t count = 0;  ///< At most those wanted.
  bool more = false;      ///< The text has more rows than wanted.
};

/// Reads rows that are not blank into records, count * record_bytes bytes, with memory for a piece of text
/// and its records per thread. Throws the IoError of the first row that cannot be read, unless it comes after
/// the rows wanted.
RowsRead read_text_rows(const TextBody& body, const RowsWanted& wanted, const ReadRow& read_row,
                        std::byte* records, const ParallelPolicy& policy);

/// Moves body.begin over at most `count` rows that are not blank; returns how many there were.
std::size_t skip_text_rows(TextBody& body, std::size_t count);

}  // namespace pcl_bv
