// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/recording/recording.h"

namespace pcl_bv {

/// A row of the table of formats.
struct RecordingFormat {
  std::string_view name;  ///< "MCAP"
  bool (*knows)(const std::filesystem::path& file,
                std::string_view start);  ///< `start`: up to 64 bytes of a file.
  std::unique_ptr<RecordingReader> (*open)(const std::filesystem::path& file);
};

const std::vector<RecordingFormat>& recording_formats();

std::unique_ptr<RecordingReader> open_db3(const std::filesystem::path& file);
bool is_rosbag2_folder(const std::filesystem::path& folder);
std::unique_ptr<RecordingReader> open_rosbag2_folder(const std::filesystem::path& folder);
/// A file of another format that is compressed whole.
std::unique_ptr<RecordingReader> open_zstd_file(const std::filesystem::path& file);
std::unique_ptr<RecordingReader> open_bag(const std::filesystem::path& file);
std::unique_ptr<RecordingReader> open_mcap(const std::filesystem::path& file);

/// "sensor_msgs/PointCloud2", as ROS 1 has it, with ROS 2's "/msg/".
std::string ros2_type(std::string_view type);

}  // namespace pcl_bv
