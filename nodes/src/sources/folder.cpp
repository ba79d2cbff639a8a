// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of clouds.

#include <algorithm>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/list_clouds.h"
#include "pcl_bv/io/read_cloud.h"
#include "sources.h"

namespace pcl_bv {

std::unique_ptr<FrameSource> open_folder(const std::string& name, const ReplayOptions& options) {
  std::error_code unknown;
  if (!std::filesystem::exists(name, unknown)) throw IoError(name + ": no such file or folder");
  std::vector<std::filesystem::path> files{name};
  if (std::filesystem::is_directory(name, unknown)) files = list_clouds(name);
  if (files.empty()) throw IoError(name + ": no cloud in this folder");
  const auto unnamed = [](const auto& file) { return stamp_in_name(file.stem().string()) < 0; };
  if (options.from_name && std::all_of(files.begin(), files.end(), unnamed))
    throw std::invalid_argument(
        files.front().string() +
        ": no time in its name, nor in others: whole numbers below 1e15 count frames");
  const std::size_t length = files.size();
  return make_replay(
      length, std::move(files), options, [fields = options.bin_fields](std::size_t, Frame& frame) {
        const auto cloud = std::make_shared<RawCloud>(read_cloud(frame.file, Serial{}, fields));
        frame.points = cloud->xyz();
        frame.note = cloud->note;
        frame.owner = cloud;
      });
}

}  // namespace pcl_bv
