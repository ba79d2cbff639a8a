// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A line belongs to the piece in which it begins, wherever it ends.
#include "text_pieces.h"

#include <algorithm>
#include <cstring>

namespace pcl_bv {
namespace {

// What a piece is read beyond its end at first, since its last line ends there: a part of this of its size.
constexpr std::size_t overhang_part = 512;

// Offset behind the first line end at or after `from`, or npos.
std::size_t behind_line_end(std::string_view text, std::size_t from) {
  const std::size_t newline = text.find('\n', from);
  return newline == std::string_view::npos ? newline : newline + 1;
}

}  // namespace

TextPieces::TextPieces(const TextBody& body)
    : body_(body), count_((body.file.size() - body.begin + body.piece_bytes - 1) / body.piece_bytes) {}

std::size_t TextPieces::piece_begin(std::size_t piece) const {
  return std::min(body_.begin + piece * body_.piece_bytes, body_.file.size());
}

// Appends `bytes` bytes of the file, from `from` on, to the `have` bytes that the buffer has.
void TextPieces::fill(ByteBuffer& buffer, std::size_t from, std::size_t bytes, std::size_t have) const {
  if (buffer.size() < have + bytes + text_padding) buffer.resize(have + bytes + text_padding);
  body_.file.read(from, buffer.data() + have, bytes);
  char* text = reinterpret_cast<char*>(buffer.data());
  if (body_.returns_end_rows) std::replace(text + have, text + have + bytes, '\r', '\n');
}

std::string_view TextPieces::fetch(std::size_t piece, ByteBuffer& buffer) const {
  // The byte before the piece tells whether a line begins with it.
  const std::size_t before = piece > 0 ? 1 : 0;
  const std::size_t begin = piece_begin(piece) - before;
  const std::size_t inside = piece_begin(piece + 1) - begin;  // the last byte may end the last line
  std::size_t have = 0, first = 0, last = std::string_view::npos;
  for (std::size_t overhang = body_.piece_bytes / overhang_part + 1;; overhang *= 2) {
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
  char* text = reinterpret_cast<char*>(buffer.data());
  std::memset(text + last, '\n', text_padding);
  return {text + first, last - first};
}

}  // namespace pcl_bv
