// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What to do with a word where a number should be, in a field that is no coordinate.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "text_rows.h"

namespace pcl_bv {

/// Values that are no numbers of their field's type are read as NaN, or as 0 by integer fields, and counted;
/// negative integers of unsigned fields wrap around as in C++ (-1 becomes the greatest). Several threads at a time;
/// what is said of them depends only on the file.
class UnreadValues {
 public:
  /// `row`: what a row is called; `first_number`: that of the first one. The cloud must outlive this object
  /// and have its data.
  UnreadValues(const RawCloud& cloud, std::string_view row, std::size_t first_number);

  /// Moves over the value here, which is of this field and belongs at `to`. False, and nothing is done, if
  /// the field is a coordinate or the row has no more values.
  bool pass_over(TextRows& rows, std::size_t field, std::byte* to);

  /// Says of the cloud which fields have such values.
  void report(RawCloud& cloud) const;

 private:
  struct OfField {
    std::atomic<std::uint64_t> count = 0;
    std::atomic<std::size_t> first_row = SIZE_MAX;
    std::string first;
  };

  const RawCloud& cloud_;
  const std::string row_;
  const std::size_t first_number_;
  std::mutex mutex_;
  std::vector<OfField> fields_;
};

}  // namespace pcl_bv
