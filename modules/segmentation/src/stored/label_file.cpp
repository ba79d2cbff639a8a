// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "label_file.h"

#include <limits>
#include <stdexcept>

namespace pcl_bv::detail {

LabelFile::LabelFile(const std::filesystem::path& folder, std::size_t points) : file_(folder) {
  file_.reserve(points * sizeof(std::uint32_t));
}

std::uint32_t LabelFile::take(std::size_t count) {
  const std::size_t first = next_.fetch_add(count);
  if (first + count > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("too many clusters for labels of 32 bits");
  return static_cast<std::uint32_t>(first);
}

void LabelFile::write(std::uint64_t first, const std::vector<std::uint32_t>& labels) {
  file_.write(first * sizeof(std::uint32_t), labels.data(), labels.size() * sizeof(std::uint32_t));
}

std::vector<std::uint32_t> LabelFile::read(std::uint64_t first, std::size_t count) const {
  std::vector<std::uint32_t> labels(count);
  file_.read(first * sizeof(std::uint32_t), labels.data(), count * sizeof(std::uint32_t));
  return labels;
}

}  // namespace pcl_bv::detail
