// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "trailing_points.h"

#include <algorithm>
#include <string>
#include <vector>

#include "fields.h"

namespace pcl_bv::detail {
namespace {

bool is_zero_padding(const InputFile& file, ByteRange rest) {
  constexpr std::size_t page = 4096;
  if (rest.end - rest.begin >= page) return false;
  std::vector<char> bytes(rest.end - rest.begin);
  file.read(rest.begin, bytes.data(), bytes.size());
  return std::all_of(bytes.begin(), bytes.end(), [](char byte) { return byte == 0; });
}

}  // namespace

void note_trailing_points(const InputFile& file, ByteRange rest, std::size_t record, RawCloud& cloud) {
  const std::size_t size = rest.end - rest.begin;
  if (size < record || is_zero_padding(file, rest)) return;
  const std::size_t points = size / record;
  const std::string bytes = std::to_string(size) + " more bytes (" + std::to_string(points) +
                            (points == 1 ? " point) follow" : " points) follow");
  if (cloud.size() == 0) throw IoError("header: 0 points, but " + bytes);
  add_note(cloud,
           "the header says " + std::to_string(cloud.size()) + " points; " + bytes + ", which are not read");
}

}  // namespace pcl_bv::detail
