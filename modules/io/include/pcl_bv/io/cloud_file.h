// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds that stay in their file: a fit holds a part of them for each thread, and what it has found so far.
#pragma once

#include <filesystem>
#include <memory>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/points/point_source.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// An open binary .pcd or .bin. Points are read where and when they are asked for, by position, so that
/// several threads read and fit side by side; the system is told what comes next, 8 MiB ahead.
///
/// A file that is changed while it is read gives an IoError, not volumes of two clouds. Its size and times
/// are looked at after each reading; and what writers can hide from those (st_mtim put back together with a
/// new link, a mapping written late) shows in a checksum of every 1024 points, kept from their first reading:
/// of one byte in 64, so that a cloud in the place of another is seen, but not each edit of one point. What
/// is cut out of 1024 points has no checksum.
class CloudFile final : public PointSource {
 public:
  /// Opens the file and reads its header only; null if its points can only be read from first to last (ascii,
  /// binary_compressed, .ply, .las), or are so few (kChunkPoints or less) that read_cloud() is the better
  /// way. Throws as read_cloud() does.
  static std::unique_ptr<CloudFile> open(const std::filesystem::path& path, std::size_t bin_fields = 0);
  ~CloudFile() override;

  /// Fields, size and viewpoint; no points.
  const RawCloud& header() const;

  /// All points, as a view that lives as long as this object.
  PointView xyz() const;

  /// Throws IoError if the file has been cut or changed since it was opened: to be called when all that was
  /// wanted of it is there.
  void require_unchanged() const;

  /// Throws IoError, also for a file that has been cut or changed since it was opened.
  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

 private:
  struct Opened;
  explicit CloudFile(std::unique_ptr<Opened> file);

  std::unique_ptr<const Opened> file_;
};

}  // namespace pcl_bv
