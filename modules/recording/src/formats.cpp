// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "formats.h"

#include "mcap_records.h"

namespace pcl_bv::detail {

const std::vector<RecordingFormat>& recording_formats() {
  using Path = std::filesystem::path;
  using Start = std::string_view;
  static const std::vector<RecordingFormat> formats{
      {"MCAP", [](const Path&, Start start) { return start.starts_with(mcap::kMagic); }, open_mcap},
      {"ROS 1 bag", [](const Path&, Start start) { return start.starts_with("#ROSBAG V2.0\n"); }, open_bag},
      // The extension is enough, because the first page of the file may be damaged.
      {"rosbag2's .db3",
       [](const Path& file, Start start) {
         return start.starts_with("SQLite format 3") || (file.extension() == ".db3" && !start.empty());
       },
       open_db3},
      {"rosbag2's .db3.zstd or .mcap.zstd",
       [](const Path& file, Start start) {
         return file.extension() == ".zstd" && start.starts_with("\x28\xB5\x2F\xFD");
       },
       open_zstd_file},
      {"rosbag2's folder", [](const Path& file, Start) { return is_rosbag2_folder(file); },
       open_rosbag2_folder}};
  return formats;
}

}  // namespace pcl_bv::detail
