// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// No output replaces an input or another output.
#pragma once

#include <filesystem>
#include <set>

namespace pcl_bv {

/// Whether this is a terminal, a pipe, /dev/null or the like: what many results may go to.
bool is_device(const std::filesystem::path& file);

/// Files by what they are, whatever links and detours lead to them.
class OutputClaims {
 public:
  void add_input(const std::filesystem::path& file);

  /// Throws UsageError if the file or folder is an input.
  void refuse_input(const std::filesystem::path& output) const;

  /// The same, and if the file is claimed already and no device.
  void claim(const std::filesystem::path& output);

 private:
  std::set<std::filesystem::path> inputs_, taken_;
};

}  // namespace pcl_bv
