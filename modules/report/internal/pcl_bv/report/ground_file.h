// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files with the lowest points of a share of a cloud, from which the ground of the whole cloud is computed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "pcl_bv/report/object_file.h"
#include "pcl_bv/report/partial_file.h"
#include "pcl_bv/segmentation/slope_surface.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// What a file says about its share.
struct GroundFileHeader {
  PartialFile cloud;    ///< The cloud and the points of the share; without a Partial.
  std::string options;  ///< Those of the ground. Files with others do not belong together.
};

/// Writes a file; a lasting one atomically, with missing folders. Equal points give equal bytes. Throws
/// IoError.
void write_ground_file(const std::filesystem::path& path, FileLife life, const GroundFileHeader& header,
                       const LowestPoints& lowest);

/// The range of the lowest points of a share, and the lowest and the highest of them.
struct GroundBounds {
  CellRange cells;
  double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();

  void add(const LowestPoint& point);
  bool contain(const LowestPoint& point) const;
};

/// A file, of which only what comes before the lowest points is in memory.
class GroundFile {
 public:
  /// Throws IoError with the reason.
  explicit GroundFile(const std::filesystem::path& path);

  const GroundFileHeader& header() const { return header_; }
  const GroundBounds& bounds() const { return bounds_; }
  /// Returns a number for the content of the file.
  std::uint64_t check_sum() const { return check_sum_; }

  /// Adds the lowest points in a range of cells. Throws IoError if the file is damaged; then some points may
  /// have been added.
  void read(const CellRange& cells, LowestPoints& lowest) const;

 private:
  std::filesystem::path path_;
  GroundFileHeader header_;
  GroundBounds bounds_;
  std::uint64_t first_point_ = 0, points_ = 0, check_sum_ = 0;
};

}  // namespace detail
}  // namespace pcl_bv
