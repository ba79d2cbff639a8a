// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/synth/synth.h"
#include "temporary_folder.h"

namespace pcl_bv {
using namespace detail;

/// A fixture with an empty folder, removed at the end.
class Folder : public testing::Test {
 protected:
  void add(const std::string& name, std::size_t points) {
    write_pcd(path_ / name, to_raw_cloud(make_synth(parse_synth("gauss:" + std::to_string(points)))));
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(path_ / name) << text; }
  std::string read(const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(path_ / name).rdbuf();
    return text.str();
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path& path_ = folder_.path();
};

}  // namespace pcl_bv
