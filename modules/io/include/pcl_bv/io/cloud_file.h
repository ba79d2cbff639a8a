// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds whose points stay in the file. A fit loads one chunk of points per thread at a time.
#pragma once

#include <filesystem>
#include <memory>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/points/point_source.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// An open binary .pcd or .bin file, whose points are read on demand. Each read passes its own file position
/// to the system, so several threads can read and fit at the same time. The operating system is asked to read
/// 8 MiB ahead.
///
/// A file that changes while it is read causes an IoError instead of a volume of mixed content. Two checks
/// detect changes:
/// - After each read, the file's size and times are compared with those when the file was opened.
/// - A checksum for each block of 1024 points is stored when the block is read first, and compared when it is
///   read again. The checksum detects changes that the times do not show. Examples are a writer that adds a
///   link to the file and restores st_mtim, and a late write through a memory mapping. A checksum covers one
///   byte in 64. It therefore detects that the cloud was replaced, but not every edit of a single point. A
///   block that is only partly read is not checked.
class CloudFile final : public PointSource {
 public:
  /// Opens the file and reads only its header. Returns null if the points can only be read from first to last
  /// (ascii, binary_compressed, .ply, .las, .laz), or if there are at most kChunkPoints points. Use
  /// read_cloud() for such files. `bin_fields` is as in ReadOptions. Throws as read_cloud() does.
  static std::unique_ptr<CloudFile> open(const std::filesystem::path& path, std::size_t bin_fields = 0);
  ~CloudFile() override;

  /// Returns the cloud's fields, size and viewpoint, without points.
  const RawCloud& header() const;

  /// Returns a view of all points, in file coordinates. The view is valid as long as this object.
  PointView xyz() const;

  /// Throws IoError if the file has been cut or changed since it was opened. Call it after the last result
  /// has been computed from the file.
  void require_unchanged() const;

  /// Reads points [first, first + count) into `buffer` and returns a view of them (see PointSource::load()).
  /// Throws IoError if the points cannot be read, or if the file has been cut or changed since it was opened.
  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

  /// Reads records [first, first + count) with all their fields, whose positions header() has, into `buffer`,
  /// which is enlarged if needed. Throws as load().
  void load_records(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const;

 private:
  struct Opened;
  explicit CloudFile(std::unique_ptr<Opened> file);

  std::unique_ptr<const Opened> file_;
};

}  // namespace pcl_bv
