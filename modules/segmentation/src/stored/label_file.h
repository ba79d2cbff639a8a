// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Labels of the points of a cloud that does not fit in memory.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "spill_file.h"

namespace pcl_bv::detail {

/// A label for each point, in a temporary file. 0 is no label. All functions may be called by several threads
/// at the same time.
class LabelFile {
 public:
  LabelFile(const std::filesystem::path& folder, std::size_t points);

  /// Returns the first of `count` labels that are not used yet.
  std::uint32_t take(std::size_t count);
  std::size_t label_count() const { return next_; }  ///< All labels are below it.

  /// Writes the labels of points with consecutive numbers.
  void write(std::uint64_t first, const std::vector<std::uint32_t>& labels);
  std::vector<std::uint32_t> read(std::uint64_t first, std::size_t count) const;

 private:
  SpillFile file_;
  std::atomic<std::size_t> next_ = 1;
};

/// Collects the labels of points with ascending numbers, and writes those of consecutive numbers together.
class LabelWriter {
 public:
  explicit LabelWriter(LabelFile* file) : file_(file) {}

  /// Does nothing without a file.
  void add(std::uint64_t number, std::uint32_t label) {
    if (file_ == nullptr) return;
    if (number != first_ + labels_.size() || labels_.size() == 4096) finish(number);
    labels_.push_back(label);
  }
  /// Writes the labels. The next one is that of point `next`.
  void finish(std::uint64_t next = 0) {
    if (file_ != nullptr && !labels_.empty()) file_->write(first_, labels_);
    labels_.clear();
    first_ = next;
  }

 private:
  LabelFile* file_;
  std::uint64_t first_ = 0;
  std::vector<std::uint32_t> labels_;
};

}  // namespace pcl_bv::detail
