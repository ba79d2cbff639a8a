// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of partial results. The points of a cloud are divided into shares, and each file has the contribution
// of one share to the volumes of the whole cloud. One machine merges all files.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pcl_bv/fitting/partial.h"
#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A Partial with the identity of its cloud and the indices of its points. Points are numbered over all
/// inputs of the cloud in the order of the inputs, and each share uses these numbers. Therefore the result is
/// the same, bit for bit, for any number of shares and any order of merging.
struct PartialFile {
  /// Value of `inputs_hash` for a cloud without inputs. It is the offset basis of FNV-1a.
  static constexpr std::uint64_t kEmptyInputsHash = 0xcbf29ce484222325;

  /// FNV-1a hash of the names and numbers of points of all inputs (see add_input()).
  std::uint64_t inputs_hash = kEmptyInputsHash;
  std::size_t inputs = 0;                 ///< Number of input files of the whole cloud.
  std::size_t cloud_points = 0;           ///< Number of points of the whole cloud, valid or not.
  std::optional<Eigen::Vector3d> origin;  ///< Vector that was subtracted from all coordinates, if any.
  std::string filter;                     ///< Description of the point filters; merge() compares it.
  Counts counts;                          ///< Dropped points of this share; only `range` and `inside`.
  /// Points of this share as ranges [first, second) of point numbers, ascending, neither empty nor adjacent.
  std::vector<std::pair<std::size_t, std::size_t>> shares;
  Partial partial;  ///< The partial results. Dropped points are treated as invalid.

  /// Adds the next input of the cloud to `inputs_hash`, `inputs` and `cloud_points`. `name` is the input's
  /// name without folders.
  void add_input(std::string_view name, std::size_t points);

  /// Merges another share into this share. Merging is associative and commutative. Throws
  /// std::invalid_argument and changes nothing if the other share has another cloud, origin, filter or type
  /// of coordinates, or if the shares have a point in common.
  void merge(const PartialFile& other);

  /// Returns whether all points of the cloud are in this share.
  bool is_whole() const;

  /// Returns a text about the points that are missing in this share, such as "points 100 to 200, 300 to 350
  /// of 400". The second number of a range is not included in the range.
  std::string missing() const;
};

/// Returns the content of a file. It is a line with the format and its version, a line of JSON with all
/// members except `partial`, the bytes of the Partial, and a CRC-32 of all preceding bytes.
std::string partial_file_content(const PartialFile& file);

/// Parses the content of a file. Throws IoError with the reason if the content is cut, changed, of another
/// version or of another format. Without `has_partial`, the Partial must be that of no points.
PartialFile parse_partial_file(std::string_view content, bool has_partial = true);

/// Writes a file atomically, and creates missing folders. Throws IoError.
void write_partial_file(const std::filesystem::path& path, const PartialFile& file);

/// Reads a file. Throws IoError, also if the file has more than 1 GiB.
PartialFile read_partial_file(const std::filesystem::path& path);

}  // namespace detail
}  // namespace pcl_bv
