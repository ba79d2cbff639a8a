// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which rows a piece of text holds is known only when all pieces before it have been read. So threads take
// pieces in order, read each into records of their own, and hand these over in order: that costs a copy out
// of the cache, where counting rows first would read the file twice.
#include "read_text_rows.h"

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <vector>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "text_pieces.h"

namespace pcl_bv {
namespace {

/// What a piece of text became.
struct PieceRows {
  ByteBuffer text;
  ByteBuffer records;
  std::size_t count = 0;            ///< Rows before the end of the text or a bad row.
  std::optional<RowError> bad_row;  ///< The one after them.
  std::exception_ptr failure;       ///< The piece could not be read at all.
};

class RowReader {
 public:
  RowReader(const TextBody& body, const RowsWanted& wanted, const ReadRow& read_row, std::byte* records)
      : pieces_(body), wanted_(wanted), read_row_(read_row), records_(records) {}

  RowsRead run(const ParallelPolicy& policy) {
    const std::size_t threads = std::min<std::size_t>(thread_count(policy), pieces_.count());
    for_each_chunk(policy, threads, [this](std::size_t) { work(); });
    if (failure_) std::rethrow_exception(failure_);
    return {std::min(rows_, wanted_.count), rows_ > wanted_.count};
  }

 private:
  // A thread waits only for pieces that others have taken before it, so that whoever has the lowest one never
  // waits.
  void work() {
    PieceRows rows;
    for (std::size_t piece = 0; take(piece);) {
      try {
        parse(piece, rows);
      } catch (...) {
        rows.failure = std::current_exception();
      }
      hand_over(piece, rows);
    }
  }

  bool take(std::size_t& piece) {
    const std::lock_guard lock(mutex_);
    if (stopped_ || next_ == pieces_.count()) return false;
    piece = next_++;
    return true;
  }

  void parse(std::size_t piece, PieceRows& rows) const {
    rows.count = 0;
    rows.bad_row.reset();
    TextRows text(pieces_.fetch(piece, rows.text));
    const std::size_t step = wanted_.record_bytes;
    try {
      while (text.find_row()) {
        const std::size_t used = rows.count * step;
        if (rows.records.size() < used + step) rows.records.resize(std::max(2 * used, used + step));
        read_row_(text, rows.records.data() + used);
        ++rows.count;
      }
    } catch (RowError& error) {
      rows.bad_row = std::move(error);
    }
  }

  void hand_over(std::size_t piece, const PieceRows& rows) {
    std::unique_lock lock(mutex_);
    turn_changed_.wait(lock, [&] { return stopped_ || turn_ == piece; });
    if (stopped_) return;
    const std::size_t first = rows_;
    accept(rows);
    ++turn_;
    lock.unlock();
    turn_changed_.notify_all();
    const std::size_t wanted = std::min(rows.count, wanted_.count - std::min(first, wanted_.count));
    if (wanted > 0) {
      std::memcpy(records_ + first * wanted_.record_bytes, rows.records.data(),
                  wanted * wanted_.record_bytes);
    }
  }

  // Of several errors the one of the first row counts; rows that are not wanted need not be right.
  void accept(const PieceRows& rows) {
    rows_ += rows.failure ? 0 : rows.count;
    if (rows.failure) {
      failure_ = rows.failure;
    } else if (rows.bad_row && rows_ < wanted_.count) {
      failure_ = std::make_exception_ptr(
          IoError(rows.bad_row->before + std::to_string(wanted_.first_number + rows_) + rows.bad_row->after));
    } else if (rows.bad_row) {
      ++rows_;
    }
    stopped_ = failure_ || rows_ > wanted_.count;
  }

  const TextPieces pieces_;
  const RowsWanted wanted_;
  const ReadRow& read_row_;
  std::byte* const records_;

  std::mutex mutex_;
  std::condition_variable turn_changed_;
  std::size_t next_ = 0;  ///< The first piece that nobody has taken.
  std::size_t turn_ = 0;  ///< The first piece that has not been handed over.
  std::size_t rows_ = 0;  ///< In the pieces that have been.
  bool stopped_ = false;
  std::exception_ptr failure_;
};

}  // namespace

RowsRead read_text_rows(const TextBody& body, const RowsWanted& wanted, const ReadRow& read_row,
                        std::byte* records, const ParallelPolicy& policy) {
  if (wanted.count == 0) {  // whatever a record would take
    TextBody rest = body;
    return {0, skip_text_rows(rest, 1) > 0};
  }
  return RowReader(body, wanted, read_row, records).run(policy);
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
      const bool ends = window[at] == '\n' || (body.returns_end_rows && window[at] == '\r');
      skipped += ends && in_row;
      in_row = !ends && (in_row || !is_blank(window[at]));
    }
    body.begin += at;
  }
  return skipped + (skipped < count && in_row);
}

}  // namespace pcl_bv
