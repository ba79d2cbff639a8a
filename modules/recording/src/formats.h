// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table of recording formats. For each format it has the functions that detect and open a file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/recording/recording.h"

namespace pcl_bv::detail {

/// A format of recordings.
struct RecordingFormat {
  std::string_view name;  ///< Name in error messages, such as "MCAP".
  /// Returns whether the file has this format. `start` is the file's first bytes, at most 64.
  bool (*matches)(const std::filesystem::path& file, std::string_view start);
  std::unique_ptr<RecordingReader> (*open)(const std::filesystem::path& file);
};

/// All formats, in the order in which they are tried.
const std::vector<RecordingFormat>& recording_formats();

std::unique_ptr<RecordingReader> open_db3(const std::filesystem::path& file);
bool is_rosbag2_folder(const std::filesystem::path& folder);
std::unique_ptr<RecordingReader> open_rosbag2_folder(const std::filesystem::path& folder);
/// Opens a file of another format that is compressed as a whole with zstd.
std::unique_ptr<RecordingReader> open_zstd_file(const std::filesystem::path& file);
std::unique_ptr<RecordingReader> open_bag(const std::filesystem::path& file);
std::unique_ptr<RecordingReader> open_mcap(const std::filesystem::path& file);

/// Returns the type name in ROS 2's spelling. For example, "sensor_msgs/PointCloud2" (ROS 1) becomes
/// "sensor_msgs/msg/PointCloud2".
std::string ros2_type(std::string_view type);

}  // namespace pcl_bv::detail
