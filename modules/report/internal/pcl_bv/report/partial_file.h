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
  std::string first_input;                ///< Name of the first input without folders. Old files lack it.
  std::size_t cloud_points = 0;           ///< Number of points of the whole cloud, valid or not.
  std::optional<Eigen::Vector3d> origin;  ///< Vector that was subtracted from all coordinates, if any.
  std::string filter;                     ///< Description of the point filters; merge() compares it.
  Counts counts;                          ///< Dropped points of this share; only `range` and `inside`.
  /// Points of this share as ranges [first, second) of point numbers, ascending, neither empty nor adjacent.
  std::vector<std::pair<std::size_t, std::size_t>> shares;
  Partial partial;  ///< The partial results. Dropped points are treated as invalid.

  /// Adds the next input of the cloud to `inputs_hash`, `inputs`, `first_input` and `cloud_points`. `name` is
  /// the input's name without folders.
  void add_input(std::string_view name, std::size_t points);

  /// Returns whether both are shares of clouds with the same inputs.
  bool has_inputs_of(const PartialFile& other) const;

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

/// Clouds of which shares were processed independently. They are parts of one cloud. Their order is the
/// natural order of the names of their first inputs; equal names are sorted by the number of points. So the
/// result does not depend on the order or the grouping in which shares are added.
class MergedClouds {
 public:
  /// Adds a share of one of the clouds, or of another one. Throws std::invalid_argument and changes nothing
  /// if the share does not belong to the others (PartialFile::merge()).
  void add(const PartialFile& share);

  const std::vector<PartialFile>& clouds() const { return clouds_; }

  /// Returns the number of points of all clouds before that of a share, which has been added.
  std::size_t points_before(const PartialFile& share) const;

  /// Throws IoError with the points that are missing, if there are any.
  void require_whole() const;

  /// Returns all clouds as one, without a hash and shares. Its Partial is for fit() only. Needs whole clouds.
  PartialFile joined() const;

 private:
  std::vector<PartialFile> clouds_;  // in their order
};

/// Returns the content of a file. It is a line with the format and its version, a line of JSON with all
/// members except `partial`, the bytes of the Partial, and a CRC-32 of all preceding bytes.
std::string partial_file_content(const PartialFile& file);

/// Parses the content of a file. Throws IoError with the reason if the content is cut, changed, of another
/// version or of another format. Without `has_partial`, the Partial must be that of no points.
PartialFile parse_partial_file(std::string_view content, bool has_partial = true);

/// Returns the content of a file with several clouds. Of one cloud it is partial_file_content(). Otherwise it
/// is a line with the format and its version, a line of JSON with the length of each cloud's content, and
/// these contents.
std::string merged_clouds_content(const MergedClouds& clouds);

/// Parses the content of a file with one or several clouds. Throws IoError as parse_partial_file() does.
MergedClouds parse_merged_clouds(std::string_view content);

/// Writes a file atomically, and creates missing folders. Throws IoError.
void write_partial_file(const std::filesystem::path& path, const MergedClouds& clouds);

/// Reads a file. Throws IoError, also if the file has more than 1 GiB.
MergedClouds read_partial_file(const std::filesystem::path& path);

}  // namespace detail
}  // namespace pcl_bv
