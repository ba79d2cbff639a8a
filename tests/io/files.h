// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files on disk for the tests: a folder of their own, whole contents, and reasons of failure.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "temporary_folder.h"

namespace pcl_bv {

std::string file_content(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, std::string_view content);

/// Returns the coordinates of all points, one after another.
std::vector<double> coordinates_of(const RawCloud& cloud);

/// A test with a folder that is removed after it.
class FileTest : public testing::Test {
 protected:
  const std::filesystem::path& folder() const { return folder_.path(); }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  /// Why read_cloud() refuses a file of this content; empty if it does not.
  std::string reason_for_content(std::string_view content, const std::string& extension = ".pcd") const;

 private:
  test::TemporaryFolder folder_;
};

/// Why read_cloud() refuses this path; empty if it does not.
std::string reason_for(const std::filesystem::path& path);

/// Root may read and write everything: while this lives, the process is nobody, if it was root.
class WithoutRoot {
 public:
  WithoutRoot();
  ~WithoutRoot();
  WithoutRoot(const WithoutRoot&) = delete;
  WithoutRoot& operator=(const WithoutRoot&) = delete;

 private:
  bool was_root_;
};

}  // namespace pcl_bv
