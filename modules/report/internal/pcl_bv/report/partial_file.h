// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a share of a cloud contributes to volumes around all of it, as a file that travels between machines.
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
#include "pcl_bv/segmentation/counts.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A Partial, of which cloud it is, and of which of its points. The cloud is numbered through all its inputs
/// in their order, and each share has its points by their numbers there: so neither the order of merging nor
/// the number of shares changes a bit.
struct PartialFile {
  /// Of a cloud without inputs.
  static constexpr std::uint64_t kNoInputs = 0xcbf29ce484222325;  // of FNV-1a

  std::uint64_t inputs_hash = kNoInputs;  ///< See add_input().
  std::size_t inputs = 0;                 ///< Files of the whole cloud.
  std::size_t cloud_points = 0;           ///< Of the whole cloud, valid or not.
  std::optional<Eigen::Vector3d> origin;  ///< What was subtracted from all coordinates, if something was.
  std::string filter;                     ///< Which points were dropped: a text that is only compared.
  Counts counts;  ///< Of this share: range and inside, which `partial` takes for invalid.
  /// Numbers of the points: from .first to before .second, ascending and neither empty nor adjacent.
  std::vector<std::pair<std::size_t, std::size_t>> shares;
  Partial partial;

  /// The next input of the cloud: its name without folders, and its points.
  void add_input(std::string_view name, std::size_t points);

  /// Adds a share: associative and commutative. Throws std::invalid_argument, and changes nothing, if it is
  /// of another cloud, origin, filter or type of coordinates, or if a point is in both.
  void merge(const PartialFile& other);

  /// Whether all points of the cloud are here.
  bool is_whole() const;

  /// "points 100 to 200, 300 to 350 of 400": which points are not here.
  std::string missing() const;
};

/// A line that names the format and its version, a line of JSON that says what it is of, the bytes of the
/// Partial, and a CRC-32 of all before.
std::string partial_file_content(const PartialFile& file);

/// Throws IoError, saying what is wrong, for anything but what partial_file_content() gave: a file that was
/// cut or changed, is of another version, or is none.
PartialFile parse_partial_file(std::string_view content);

/// Atomically, as all outputs. Throws IoError.
void write_partial_file(const std::filesystem::path& path, const PartialFile& file);

/// Throws IoError. Files of more than 1 GiB are refused.
PartialFile read_partial_file(const std::filesystem::path& path);

}  // namespace pcl_bv
