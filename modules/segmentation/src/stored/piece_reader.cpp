// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "piece_reader.h"

#include <algorithm>

namespace pcl_bv::detail {

PieceReader::PieceReader(const SpillFile& file, const Piece& piece, ScalarType scalar,
                         std::size_t buffer_bytes)
    : file_(&file),
      from_(piece.from),
      at_(piece.offset),
      left_(piece.points),
      first_number_(from_.share != nullptr ? from_.share->first_number : 0),
      scalar_(scalar),
      step_(record_bytes(scalar)),
      max_records_(std::max<std::size_t>(buffer_bytes / step_, 1)),
      sum_(run_check_sum(nullptr, 0)) {
  fill();
}

void PieceReader::next() {
  position_ += step_;
  if (done()) fill();
}

void PieceReader::fill() {
  const std::size_t records = std::min<std::uint64_t>(left_, max_records_);
  buffer_.resize(records * step_);
  position_ = 0;
  if (from_.share == nullptr) {
    file_->read(at_, buffer_.data(), buffer_.size());
  } else {
    try {
      from_.share->read(at_, buffer_.data(), buffer_.size());
    } catch (const std::runtime_error& error) {
      throw ShareError(from_.number, error.what());
    }
    sum_ = run_check_sum(buffer_.data(), buffer_.size(), sum_);
    if (left_ == records && stored_sum(sum_) != from_.check_sum)
      throw ShareError(from_.number, "its points are damaged", true);
  }
  at_ += buffer_.size();
  left_ -= records;
}

}  // namespace pcl_bv::detail
