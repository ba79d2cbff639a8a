// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of clouds.

#include <algorithm>
#include <chrono>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/list_clouds.h"
#include "pcl_bv/io/read_cloud.h"
#include "sources.h"

namespace pcl_bv {
namespace {

class FolderSource : public FrameSource {
 public:
  FolderSource(std::vector<std::filesystem::path> files, const ReplayOptions& options)
      : files_(std::move(files)), bin_fields_(options.bin_fields), replay_(files_.size(), options) {}

  Next next(Frame& frame, std::chrono::milliseconds) override {
    if (replay_.ended()) return Next::end;
    frame = replay_.begin(files_[replay_.place()].string(), "");
    const auto begin = std::chrono::steady_clock::now();
    try {
      const auto cloud = std::make_shared<RawCloud>(read_cloud(frame.file, Serial{}, bin_fields_));
      frame.points = cloud->xyz();
      frame.owner = cloud;
    } catch (const std::exception& error) {
      throw FrameError(std::move(frame), error.what());
    }
    frame.decode_ms = milliseconds_since(begin);
    return Next::frame;
  }

 private:
  std::vector<std::filesystem::path> files_;
  std::size_t bin_fields_;
  Replay replay_;
};

}  // namespace

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
  return std::make_unique<FolderSource>(std::move(files), options);
}

}  // namespace pcl_bv
