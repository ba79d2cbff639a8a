// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "pcl_bv/nodes/frame.h"

namespace pcl_bv {

/// The file of ReplayOptions::poses.
class Poses {
 public:
  Poses() = default;

  /// Throws IoError, naming the file and the line, for what it cannot read, and where frames are numbered and
  /// there are not as many as `frames`.
  Poses(const std::filesystem::path& file, std::size_t frames);

  std::optional<Pose> at(std::size_t number, std::int64_t stamp_ns) const;

 private:
  bool by_stamp_ = false;
  std::vector<std::pair<std::int64_t, Pose>> poses_;  // stamps rise
};

}  // namespace pcl_bv
