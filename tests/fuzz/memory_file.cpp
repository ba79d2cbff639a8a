// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// See memory_file.h.
#include "memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
namespace {

void require(bool holds, const char* rule) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", rule);
  std::abort();
}

bool is_one_printable_line(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

// Every coordinate is looked at, so that a view beyond the data cannot go unnoticed.
double sum_of_coordinates(const PointView& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    sum += p.x + p.y + p.z;
  }
  return sum;
}

}  // namespace

MemoryFile::MemoryFile() : fd_(::memfd_create("fuzz", MFD_CLOEXEC)) {
  require(fd_ >= 0, "memory for a file");
}

MemoryFile::~MemoryFile() {
  ::close(fd_);
}

void MemoryFile::assign(std::string_view content) {
  require(::ftruncate(fd_, static_cast<off_t>(content.size())) == 0, "a file takes any size");
  require(::pwrite(fd_, content.data(), content.size(), 0) == static_cast<ssize_t>(content.size()),
          "a file takes its content");
}

std::filesystem::path MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(fd_);
}

void check_reader(std::string_view content, std::size_t expansion, const Reader& read) {
  static MemoryFile file;
  file.assign(content);
  try {
    const RawCloud cloud = read(file.path());
    require(cloud.data.size() == cloud.size() * cloud.point_step, "data holds all points");
    require(cloud.data.size() <= content.size() * expansion, "a small file asks for little memory");
    const PointView points = cloud.xyz();
    require(points.count == cloud.size(), "a cloud that can be read has coordinates");
    volatile double sum = sum_of_coordinates(points);
    static_cast<void>(sum);
  } catch (const IoError& error) {
    require(is_one_printable_line(error.what()), "a reason is one printable line");
  }
}

}  // namespace pcl_bv
