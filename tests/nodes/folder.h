// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/synth/synth.h"

namespace pcl_bv {
using namespace detail;

/// A fixture with an empty folder, removed at the end.
class Folder : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() / ("pcl_bv_streams_" + std::to_string(::getpid()));
    std::filesystem::create_directories(path_);
  }
  void TearDown() override { std::filesystem::remove_all(path_); }

  void add(const std::string& name, std::size_t points) {
    write_pcd(path_ / name, to_raw_cloud(make_synth(parse_synth("gauss:" + std::to_string(points)))));
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(path_ / name) << text; }
  std::string read(const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(path_ / name).rdbuf();
    return text.str();
  }

  std::filesystem::path path_;
};

}  // namespace pcl_bv
