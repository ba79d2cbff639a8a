// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "text_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "fields.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "separated_text.h"
#include "text.h"

namespace pcl_bv::detail {
namespace {

// Fast path for "nan" as PCL writes it, which is frequent in organised clouds. std::from_chars reads all
// other forms.
template <typename T>
const char* read_nan(const char* at, T& value) {
  if (std::memcmp(at, "nan", 3) != 0 || !ends_value(at[3])) return nullptr;
  value = std::numeric_limits<T>::quiet_NaN();
  return at + 3;
}

// Reads an integer that is written with a decimal point or an exponent.
template <typename T>
const char* read_whole_number(const char* at, const char* end, T& value) {
  constexpr double largest = 9007199254740992;  // doubles do not represent every integer above 2^53
  double number = 0;
  const char* const after = parse_number(at, end, number);
  if (after == nullptr || !ends_value(*after) || !(std::abs(number) <= largest) ||
      number != std::trunc(number))
    return nullptr;
  const auto whole = static_cast<std::int64_t>(number);
  const bool fits = std::in_range<T>(whole);
  value = static_cast<T>(whole);
  return fits ? after : nullptr;
}

template <typename T>
const char* read_number(const char* at, const char* end, T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    if (const char* after = read_short_decimal(at, value)) return after;
    if (const char* after = read_nan(at, value)) return after;
  }
  const char* after = parse_number(at, end, value);
  if (after && ends_value(*after)) return after;
  if constexpr (std::is_integral_v<T>) return read_whole_number(at, end, value);
  return nullptr;
}

// At first, a piece is read together with 1/512 as many bytes behind the piece. The last line of the piece
// usually ends in these bytes.
constexpr std::size_t kOverhangFraction = 512;

// Returns the offset behind the first line end at or after `from`, or npos.
std::size_t behind_line_end(std::string_view text, std::size_t from) {
  const std::size_t newline = text.find('\n', from);
  return newline == std::string_view::npos ? newline : newline + 1;
}

// Splits a text at line ends into pieces that fit in a core's cache. Each piece can be read independently. A
// line belongs to the piece in which it begins.
class TextPieces {
 public:
  explicit TextPieces(const TextBody& body)
      : body_(body), count_((body.file.size() - body.begin + body.piece_bytes - 1) / body.piece_bytes) {}

  std::size_t count() const { return count_; }

  // Reads the lines of a piece into a reusable buffer, with the padding that TextRows needs. Returns an empty
  // text if no line begins in the piece. Throws IoError.
  std::string_view fetch(std::size_t piece, ByteBuffer& buffer) const {
    // The byte before the piece is also read. If it is a line end, a line begins at the first byte of the
    // piece.
    const std::size_t before = piece > 0 ? 1 : 0;
    const std::size_t begin = piece_begin(piece) - before;
    const std::size_t inside = piece_begin(piece + 1) - begin;  // bytes before the next piece
    std::size_t have = 0, first = 0, last = std::string_view::npos;
    for (std::size_t overhang = body_.piece_bytes / kOverhangFraction + 1;; overhang *= 2) {
      const std::size_t want = std::min(inside + overhang, body_.file.size() - begin);
      fill(buffer, begin + have, want - have, have);
      const std::string_view text(reinterpret_cast<const char*>(buffer.data()), want);
      if (have == 0) first = before == 0 ? 0 : behind_line_end(text, 0);
      if (first >= inside && piece + 1 < count_) return {};
      last = behind_line_end(text, std::max(have, inside - 1));
      have = want;
      if (last != std::string_view::npos || begin + have == body_.file.size()) break;
    }
    last = std::min(last, have);
    first = std::min(first, last);
    if (body_.separator != ' ') return separated(buffer, first, last);
    return padded(buffer, first, last);
  }

 private:
  std::size_t piece_begin(std::size_t piece) const {
    return std::min(body_.begin + piece * body_.piece_bytes, body_.file.size());
  }

  // Reads `bytes` bytes of the file from offset `from` into the buffer, behind its first `have` bytes.
  void fill(ByteBuffer& buffer, std::size_t from, std::size_t bytes, std::size_t have) const {
    if (buffer.size() < have + bytes + kTextPadding) buffer.resize(have + bytes + kTextPadding);
    body_.file.read(from, buffer.data() + have, bytes);
    char* text = reinterpret_cast<char*>(buffer.data());
    if (body_.cr_ends_row) std::replace(text + have, text + have + bytes, '\r', '\n');
  }

  static std::string_view padded(ByteBuffer& buffer, std::size_t first, std::size_t last) {
    char* const text = reinterpret_cast<char*>(buffer.data());
    std::memset(text + last, '\n', kTextPadding);
    return {text + first, last - first};
  }

  // Returns the lines [first, last) with blanks between their values. Lines whose separators cannot just be
  // replaced are written behind the others.
  std::string_view separated(ByteBuffer& buffer, std::size_t first, std::size_t last) const {
    char* text = reinterpret_cast<char*>(buffer.data());
    const std::string_view lines(text + first, last - first);
    if (has_plain_values(lines, body_.separator)) {
      std::replace(text + first, text + last, body_.separator, ' ');
      return padded(buffer, first, last);
    }
    const std::size_t end = last + 2 * lines.size() + 2 + kTextPadding;
    if (buffer.size() < end) buffer.resize(end);
    text = reinterpret_cast<char*>(buffer.data());
    const char* const written =
        separate_by_blanks({text + first, last - first}, body_.separator, body_.columns, text + last);
    return padded(buffer, last, static_cast<std::size_t>(written - text));
  }

  TextBody body_;
  std::size_t count_;
};

std::size_t count_rows_one_by_one(std::string_view text) {
  std::size_t rows = 0;
  bool in_row = false;
  for (const char c : text) {
    rows += !in_row && !ends_value(c);
    in_row = c != '\n' && (in_row || !ends_value(c));
  }
  return rows;
}

// Counts the rows. If no line begins with a blank, these are the lines that begin with a value, which is fast
// to count. Otherwise counts byte by byte. Counters of 8 bits, which are enough for a block of 240 bytes, let
// the compiler vectorise the loop.
std::size_t count_rows(std::string_view text) {
  constexpr std::size_t block = 240;
  std::size_t rows = !text.empty() && !ends_value(text[0]), others = !text.empty() && is_blank(text[0]);
  for (std::size_t begin = 1; begin < text.size(); begin += block) {
    const std::size_t n = std::min(block, text.size() - begin);
    const auto* before = reinterpret_cast<const std::uint8_t*>(text.data()) + begin - 1;
    const std::uint8_t* at = before + 1;
    std::uint8_t rows_here = 0, others_here = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint8_t begins = before[i] == '\n';
      const std::uint8_t is_end = at[i] == '\n';
      const std::uint8_t is_space = at[i] == ' ';
      const std::uint8_t is_control = static_cast<std::uint8_t>(at[i] - '\t') <= '\r' - '\t';
      rows_here += begins & ((is_space | is_control) ^ 1);
      others_here += begins & (is_space | is_control) & (is_end ^ 1);
    }
    rows += rows_here;
    others += others_here;
  }
  return others == 0 ? rows : count_rows_one_by_one(text);
}

// Reads rows with several threads. The number of a row is known only when the rows of all pieces before its
// piece have been counted. Therefore the threads first count the rows of all pieces, at a tenth of the cost
// of parsing. Then each piece is parsed directly into its records, and no thread has to wait for the parsing
// of earlier pieces.
class RowReader {
 public:
  RowReader(const TextBody& body, const RowsWanted& wanted, const ReadRow& read_row, std::byte* records)
      : pieces_(body), wanted_(wanted), read_row_(read_row), records_(records) {}

  RowsRead run_serial() const {
    ByteBuffer text;
    std::size_t rows = 0;
    for (std::size_t piece = 0; piece < pieces_.count() && rows <= wanted_.count; ++piece)
      rows = read_piece(piece, rows, wanted_.count, text);
    return {std::min(rows, wanted_.count), rows > wanted_.count};
  }

  RowsRead run_parallel(const ParallelPolicy& policy) const {
    std::vector<std::size_t> end(pieces_.count());  // number of rows up to the end of each piece
    over_pieces(policy, [&](std::size_t piece, ByteBuffer& text) {
      end[piece] = count_rows(pieces_.fetch(piece, text));
    });
    std::partial_sum(end.begin(), end.end(), end.begin());
    over_pieces(policy, [&](std::size_t piece, ByteBuffer& text) {
      const std::size_t first = piece == 0 ? 0 : end[piece - 1];
      if (first >= wanted_.count) return;
      const std::size_t stop = std::min(end[piece], wanted_.count);
      const std::size_t found = read_piece(piece, first, stop, text);
      if (found != std::min(end[piece], stop + 1)) throw IoError(kChangedWhileRead);
    });
    return {std::min(end.back(), wanted_.count), end.back() > wanted_.count};
  }

 private:
  // Four successive pieces form a group and share a buffer. for_each_range() throws the error of the first
  // group that failed, which is the error of the first invalid row.
  template <typename Body>
  void over_pieces(const ParallelPolicy& policy, const Body& body) const {
    constexpr std::size_t group = 4;
    for_each_range(policy, pieces_.count(), group, [&](std::size_t begin, std::size_t end) {
      ByteBuffer text;
      for (std::size_t piece = begin; piece < end; ++piece)
        body(piece, text);
    });
  }

  // Reads the rows of a piece as rows `row` to `stop` - 1. Returns the number after the last row that was
  // read, or stop + 1 if the piece has further rows.
  std::size_t read_piece(std::size_t piece, std::size_t row, std::size_t stop, ByteBuffer& buffer) const {
    TextRows text(pieces_.fetch(piece, buffer));
    try {
      for (; text.find_row(); ++row) {
        if (row == stop) return row + 1;
        read_row_(text, records_ + row * wanted_.record_bytes);
      }
    } catch (const RowError& error) {
      throw IoError(error.before + std::to_string(wanted_.first_number + row) + error.after);
    }
    return row;
  }

  const TextPieces pieces_;
  const RowsWanted wanted_;
  const ReadRow& read_row_;
  std::byte* const records_;
};

}  // namespace

std::uint32_t TextRows::read(const PointField& field, std::byte* to) {
  return with_element_type(field, [&, count = field.count](auto value) {
    const char* at = at_;
    std::uint32_t read = 0;
    for (; read < count; ++read) {
      while (is_blank(*at))
        ++at;
      const char* after = *at == '\n' ? nullptr : read_number(at, end_, value);
      if (!after) break;
      std::memcpy(to + read * sizeof value, &value, sizeof value);
      at = after;
    }
    at_ = at;
    return read;
  });
}

std::string_view TextRows::value() const {
  const char* stop = at_;
  while (!ends_value(*stop))
    ++stop;
  return {at_, static_cast<std::size_t>(stop - at_)};
}

std::string TextRows::quoted_value() const {
  std::string text(value());
  if (text == std::string_view(&kInnerBlank, 1)) text.clear();
  std::replace(text.begin(), text.end(), kInnerBlank, ' ');
  return in_quotes(text);
}

bool extend_run(PointField& run, const PointField& next) {
  const bool fits = run.count <= std::numeric_limits<std::uint32_t>::max() - next.count;
  if (run.type != next.type || run.size != next.size || !fits) return false;
  run.count += next.count;
  return true;
}

RowsRead read_text_rows(const TextBody& body, const RowsWanted& wanted, const ReadRow& read_row,
                        std::byte* records, const ParallelPolicy& policy) {
  if (wanted.count == 0) {  // only check whether there are rows
    TextBody rest = body;
    return {0, skip_text_rows(rest, 1) > 0};
  }
  const RowReader reader(body, wanted, read_row, records);
  const bool alone = thread_count(policy) == 1 || body.file.size() - body.begin <= body.piece_bytes;
  return alone ? reader.run_serial() : reader.run_parallel(policy);
}

std::size_t skip_text_rows(TextBody& body, std::size_t count) {
  std::vector<char> window(65536);
  std::size_t skipped = 0;
  bool in_row = false;
  while (skipped < count && body.begin < body.file.size()) {
    const std::size_t bytes = std::min(window.size(), body.file.size() - body.begin);
    body.file.read(body.begin, window.data(), bytes);
    std::size_t at = 0;
    for (; at < bytes && skipped < count; ++at) {
      const bool ends = window[at] == '\n' || (body.cr_ends_row && window[at] == '\r');
      skipped += ends && in_row;
      in_row = !ends && (in_row || !(is_blank(window[at]) || window[at] == body.separator));
    }
    body.begin += at;
  }
  return skipped + (skipped < count && in_row);
}

}  // namespace pcl_bv::detail
