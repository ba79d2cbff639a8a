// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ensures that no output overwrites an input or another output.
#pragma once

#include <filesystem>
#include <set>

namespace pcl_bv::detail {

/// Returns whether the file is a terminal, a pipe, /dev/null or similar, to which several results may be
/// written.
bool is_device(const std::filesystem::path& file);

/// Returns whether an output may have any name: it is a device, or in /dev, such as /dev/stdout.
bool needs_no_suffix(const std::filesystem::path& file);

/// Throws UsageError if the path is `-`: outputs have no short name for standard output.
void reject_dash(const std::filesystem::path& output);

/// Throws IoError if the folder in which the file is to be created does not exist.
void require_folder_of(const std::filesystem::path& file);

/// The inputs and outputs of a command. Files are compared by canonical path, so links do not matter.
class OutputClaims {
 public:
  void add_input(const std::filesystem::path& file);

  /// Throws UsageError if the file or folder is an input.
  void reject_input(const std::filesystem::path& output) const;

  /// Registers an output. Throws UsageError if it is `-` or an input, or if it is already registered and not
  /// a device.
  void claim(const std::filesystem::path& output);

  /// Registers an output whose file is not replaced, but written in place. Also throws UsageError if a hard
  /// link to an input has this name.
  void claim_in_place(const std::filesystem::path& output);

  /// Registers a folder for several outputs. Also throws UsageError if an input is in the folder.
  void claim_folder(const std::filesystem::path& folder);

 private:
  std::set<std::filesystem::path> inputs_, taken_;
};

}  // namespace pcl_bv::detail
