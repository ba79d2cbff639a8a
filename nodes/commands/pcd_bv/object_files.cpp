// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "object_files.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <string>
#include <vector>

#include "commands/shared/messages.h"
#include "copy_points.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

std::string pcd_header(const PointView& points) {
  const std::string count = std::to_string(points.count);
  const std::string sizes = points.scalar == ScalarType::float32 ? "4 4 4" : "8 8 8";
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE " + sizes +
         "\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
         count + "\nDATA binary\n";
}

}  // namespace

void write_object(const std::filesystem::path& folder, std::size_t id, const PointView& points) {
  const std::filesystem::path path = folder / (std::to_string(id) + ".pcd");
  try {
    write_file_atomically(path, [&](const FileSink& write) {
      write(pcd_header(points));
      std::vector<std::byte> bytes;
      for (std::size_t begin = 0; begin < points.count; begin += kChunkPoints) {
        const LoadedPoints loaded(points, begin, std::min(kChunkPoints, points.count - begin));
        bytes.resize(loaded.view().count * 3 * size_of(points.scalar));
        copy_points(loaded.view(), points.scalar, bytes.data());
        write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
      }
    });
  } catch (const std::exception& error) {
    throw IoError(path.string() + ": " + reason_of(error));
  }
}

Status write_objects(const std::filesystem::path& folder, std::size_t count, const ParallelPolicy& policy,
                     const std::function<void(std::size_t id)>& write) {
  try {
    try {
      create_folder(folder);
    } catch (const IoError& error) {
      throw IoError(folder.string() + ": " + error.what());
    }
    std::atomic<bool> failed = false;
    for_each_chunk(policy, count, [&](std::size_t id) {
      if (failed) return;
      try {
        write(id);
      } catch (...) {
        failed = true;
        throw;
      }
    });
    return Status::done;
  } catch (const std::exception& error) {
    report_problem(reason_of(error));
    return Status::failed;
  }
}

}  // namespace pcl_bv::detail
