// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A text cut at line ends into pieces that fit a core's cache, each of which can be fetched by itself.
#pragma once

#include <cstddef>
#include <string_view>

#include "pcl_bv/io/byte_buffer.h"
#include "read_text_rows.h"

namespace pcl_bv {

/// The lines that begin in a stretch of the text.
class TextPieces {
 public:
  explicit TextPieces(const TextBody& body);

  std::size_t count() const { return count_; }

  /// The lines of a piece, in a buffer that can be used again, with the padding that TextRows needs. Empty if
  /// none begins there. Throws IoError.
  std::string_view fetch(std::size_t piece, ByteBuffer& buffer) const;

 private:
  std::size_t piece_begin(std::size_t piece) const;
  void fill(ByteBuffer& buffer, std::size_t from, std::size_t bytes, std::size_t have) const;

  TextBody body_;
  std::size_t count_;
};

}  // namespace pcl_bv
