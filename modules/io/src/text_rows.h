// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads the rows of a text file in pieces with several threads. The result is the same as with one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/execution.h"
#include "short_decimal.h"

namespace pcl_bv::detail {

/// A cursor over a text of rows (lines) of values separated by blanks. TextRows does not own the text. The
/// text must be followed by kTextPadding readable bytes that begin with a line feed.
class TextRows {
 public:
  explicit TextRows(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

  /// Moves to the next value, also across line ends. Returns false at the end of the text.
  bool find_row() {
    while (at_ != end_ && ends_value(*at_))
      ++at_;
    return at_ != end_;
  }

  /// Moves to the next value of the row. Returns false if the row has no more values.
  bool find_value() {
    while (is_blank(*at_))
      ++at_;
    return *at_ != '\n';
  }

  /// Reads the next values of the row as the elements of one field. Stops at the first value that is missing
  /// or not a number of the field's type. Returns the number of values read. Integer fields accept whole
  /// numbers in any notation (1.0, 1e3).
  std::uint32_t read(const PointField& field, std::byte* to);

  /// Reads all elements of one field. Calls on_invalid(index of the element, target address of the element)
  /// for each value that is missing or not a number of the field's type. `on_invalid` must throw, or skip the
  /// value and write another value to the target.
  template <typename OnInvalid>
  void read_all(const PointField& field, std::byte* to, const OnInvalid& on_invalid) {
    std::uint32_t found = read(field, to);
    while (found < field.count) {
      on_invalid(found, to + std::size_t{found} * field.size);
      PointField rest = field;
      rest.count -= ++found;
      found += read(rest, to + std::size_t{found} * field.size);
    }
  }

  /// Moves behind the value at the cursor, without parsing it.
  void skip_value() { at_ += value().size(); }

  /// Returns the text of the value at the cursor.
  std::string_view value() const;

  /// Returns the value at the cursor as in_quotes(), with the blanks that the file has.
  std::string quoted_value() const;

 private:
  const char* at_;
  const char* end_;
};

/// Adds the elements of the next field to `run`, so that one call of TextRows::read() reads all of them.
/// Returns false and changes nothing if the types or sizes of `run` and `next` differ, or if the number of
/// elements would overflow.
bool extend_run(PointField& run, const PointField& next);

/// Bytes of text per piece. A piece and its records fit in the second-level cache.
inline constexpr std::size_t kTextPieceBytes = 256 << 10;

/// The rows of a file.
struct TextBody {
  const InputFile& file;
  std::size_t begin;                          ///< Byte offset of the first row.
  bool cr_ends_row;                           ///< Whether a carriage return alone also ends a row.
  char separator = ' ';                       ///< Between values, see separate_by_blanks().
  std::size_t piece_bytes = kTextPieceBytes;  ///< Bytes that are read at a time.
  std::size_t columns = 0;                    ///< Values of a row, with a separator other than ' '.
};

/// Thrown for a row that cannot be read. The message is `before`, then the number of the row, then `after`.
struct RowError {
  std::string before, after;
};

/// The rows to read.
struct RowsWanted {
  std::size_t first_number;  ///< Number of the first row in error messages.
  std::size_t count;         ///< Number of rows.
  std::size_t record_bytes;  ///< Bytes of the record of one row.
};

/// Reads the row at the cursor into the record and moves the cursor to the row's end. Throws RowError.
using ReadRow = std::function<void(TextRows& rows, std::byte* record)>;

struct RowsRead {
  std::size_t count = 0;  ///< Number of rows read, at most those wanted.
  bool more = false;      ///< Whether the text has more rows than wanted.
};

/// Reads rows that are not blank into `records`, which has wanted.count * wanted.record_bytes bytes. Each
/// thread needs memory for one piece of text. Throws an IoError for the first wanted row that cannot be read.
RowsRead read_text_rows(const TextBody& body, const RowsWanted& wanted, const ReadRow& read_row,
                        std::byte* records, const ParallelPolicy& policy);

/// Moves body.begin behind the next `count` rows that are not blank, or to the end of the file if there are
/// fewer. Returns the number of rows skipped.
std::size_t skip_text_rows(TextBody& body, std::size_t count);

}  // namespace pcl_bv::detail
