// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "formats.h"

#include "mcap_records.h"

namespace pcl_bv {

const std::vector<RecordingFormat>& recording_formats() {
  static const std::vector<RecordingFormat> formats{
      {"MCAP",
       [](const std::filesystem::path&, std::string_view start) { return start.starts_with(mcap::kMagic); },
       open_mcap},
      {"ROS 1 bag",
       [](const std::filesystem::path&, std::string_view start) {
         return start.starts_with("#ROSBAG V2.0\n");
       },
       open_bag}};
  return formats;
}

std::string ros2_type(std::string_view type) {
  std::string name(type);
  const std::size_t slash = name.find('/');
  if (slash != std::string::npos && name.find('/', slash + 1) == std::string::npos)
    name.insert(slash, "/msg");
  return name;
}

}  // namespace pcl_bv
