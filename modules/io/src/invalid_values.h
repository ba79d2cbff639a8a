// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Replaces and counts the values of a text file that are not numbers, in fields other than coordinates.
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

namespace pcl_bv::detail {

/// Replaces and counts invalid values, which are not numbers of their field's type. They become NaN, or 0 in
/// integer fields. Negative integers in unsigned fields are valid if they fit in the signed type of the same
/// size and in 32 bits. They wrap around as in C++ (-1 becomes the maximum). Thread-safe. The report is the
/// same for any number of threads.
class InvalidValues {
 public:
  /// `row` is the word for a row in messages, and `first_number` is the number of the first row. The cloud
  /// must outlive this object, and its `data` must have its final size.
  InvalidValues(const RawCloud& cloud, std::string_view row, std::size_t first_number);

  /// Skips the value at the cursor, which belongs to field number `field`, writes the replacement to `to` and
  /// returns true. Returns false and replaces nothing if the field is a coordinate or the row has no more
  /// values.
  bool replace_value(TextRows& rows, std::size_t field, std::byte* to);

  /// Adds the fields with invalid values to the cloud's note and to RawCloud::invalid_fields.
  void report(RawCloud& cloud) const;

 private:
  struct FieldRecord {
    std::atomic<std::uint64_t> count = 0;
    std::atomic<std::size_t> first_row = SIZE_MAX;
    std::string first;
  };

  const RawCloud& cloud_;
  const std::string row_;
  const std::size_t first_number_;
  std::mutex mutex_;
  std::vector<FieldRecord> fields_;
};

}  // namespace pcl_bv::detail
