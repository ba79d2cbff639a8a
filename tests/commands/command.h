// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs the built commands as a user does, in a folder of the test's own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "temporary_folder.h"

namespace pcl_bv::test {

using Json = nlohmann::ordered_json;

struct Result {
  int status = -1;  ///< 128 + signal if it was killed.
  std::string out;
  std::string err;

  std::size_t error_lines() const;
  std::string problems() const;  ///< `err` without the summary of several inputs.
  Json json() const { return Json::parse(out); }
};

struct Surroundings {
  std::string program = "pcd_bv";  ///< In the folder of the built programs, or a path.
  std::string isa{};               ///< PCL_BV_ISA; empty: as this test has it.
  std::string output{};            ///< File to be standard output; empty: captured.
  bool nobody_reads = false;       ///< Standard output is a pipe whose reader has gone.
  bool terminal = false;           ///< Standard error is a terminal of 80 columns.
  std::vector<int> closed{};       ///< Descriptors that are closed from the start.
  /// Done while it runs, with its number. What it has written so far is in captured.out and captured.err.
  std::function<void(int process)> meanwhile{};
};

/// Whether this system gives out pseudo-terminals: a bare chroot has none.
bool has_terminals();

std::string read_file(const std::filesystem::path& path);

/// A fixture with an empty folder, removed at the end.
class PcdBv : public testing::Test {
 protected:
  Result run(const std::vector<std::string>& arguments, const Surroundings& surroundings = {}) const;

  /// The path, as text, of a file or folder in the test's folder.
  std::string at(std::string_view name) const { return (folder_ / name).string(); }

  /// Each makes a file and gives its path.
  std::string file(std::string_view name, std::string_view content) const;
  std::string ascii(std::string_view name, const std::vector<std::string>& points) const;

  /// A .pcd header for float32 x y z.
  static std::string header(std::size_t points, std::string_view data = "ascii");

 private:
  test::TemporaryFolder folder_;
};

}  // namespace pcl_bv::test
