// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// See files.h.
#include "files.h"

#include <stdlib.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {

namespace fs = std::filesystem;

std::string file_content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Removed first: ext4 flushes a file that is cut to nothing and written again, 4 ms each for thousands of
// files.
void write_text(const fs::path& path, std::string_view content) {
  fs::remove(path);
  std::ofstream(path, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

std::vector<double> coordinates_of(const RawCloud& cloud) {
  std::vector<double> found;
  const PointView points = cloud.xyz();
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    found.insert(found.end(), {p.x, p.y, p.z});
  }
  return found;
}

std::string FileTest::reason_for_content(std::string_view content, const std::string& extension) const {
  write_text(file("content" + extension), content);
  return reason_for(file("content" + extension));
}

std::string reason_for(const fs::path& path) {
  try {
    read_cloud(path);
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

WithoutRoot::WithoutRoot() : was_root_(::geteuid() == 0) {
  if (was_root_ && ::seteuid(65534) != 0) throw std::runtime_error("cannot become nobody");
}

WithoutRoot::~WithoutRoot() {
  if (was_root_ && ::seteuid(0) != 0) abort();
}

}  // namespace pcl_bv
