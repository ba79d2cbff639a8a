// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of text rows, read in pieces by several threads; what comes out is as if one had read them in order.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "pcl_bv/io/byte_buffer.h"
#include "pcl_bv/parallel/policy.h"
#include "posix_file.h"
#include "text_rows.h"

namespace pcl_bv {

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
