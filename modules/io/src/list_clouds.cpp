// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers in names are compared as text without leading zeros, so that long numbers cannot overflow.
#include "pcl_bv/io/list_clouds.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <system_error>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Removes the run of digits at the beginning of `text` and returns it without leading zeros.
std::string_view take_number(std::string_view& text) {
  std::string_view number = text.substr(0, text.find_first_not_of("0123456789"));
  text.remove_prefix(number.size());
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

// Returns a negative value, zero or a positive value, like std::string_view::compare().
int compare_natural(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view m = take_number(a);
      const std::string_view n = take_number(b);
      if (m.size() != n.size()) return m.size() < n.size() ? -1 : 1;
      if (const int order = m.compare(n)) return order;
    } else {
      if (const int order = a.substr(0, 1).compare(b.substr(0, 1))) return order;
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  return static_cast<int>(!a.empty()) - static_cast<int>(!b.empty());
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  const int order = compare_natural(a, b);
  return order != 0 ? order < 0 : a < b;
}

std::vector<fs::path> list_clouds(const fs::path& folder, std::size_t* subfolders) {
  std::vector<fs::path> clouds;
  std::size_t folders = 0;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;  // after an error the entry is listed, and reading it gives the reason
    if (entry->path().filename().native().front() == '.') continue;
    if (entry->is_directory(ignored)) {
      ++folders;
    } else if (is_cloud_name(entry->path())) {
      clouds.push_back(entry->path());
    }
  }
  if (error) throw IoError("cannot list the folder: " + system_reason(error.value()));
  if (subfolders != nullptr) *subfolders = folders;
  std::sort(clouds.begin(), clouds.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().native(), b.filename().native());
  });
  return clouds;
}

}  // namespace pcl_bv::detail
