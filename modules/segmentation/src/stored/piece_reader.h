// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads the records of pieces and runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "brick_clusters.h"
#include "pcl_bv/segmentation/cluster_share.h"
#include "spill_file.h"

namespace pcl_bv::detail {

/// Reads the records of a piece one after another.
class PieceReader {
 public:
  /// `buffer_bytes` are read at a time, and at least one record.
  PieceReader(const SpillFile& file, const Piece& piece, ScalarType scalar, std::size_t buffer_bytes);

  bool done() const { return position_ == buffer_.size(); }
  const std::byte* record() const { return buffer_.data() + position_; }
  /// Number of the point in the merged cloud.
  std::uint64_t number() const { return (number_of_record(record(), scalar_) & kNumberMask) + first_number_; }
  /// Goes to the next record. Throws ShareError if the check sum of a run is wrong at its end.
  void next();

 private:
  void fill();

  const SpillFile* file_;
  PieceOfShare from_;
  std::uint64_t at_, left_, first_number_;
  ScalarType scalar_;
  std::size_t step_, max_records_, position_ = 0;
  std::uint32_t sum_;
  std::vector<std::byte> buffer_;
};

}  // namespace pcl_bv::detail
