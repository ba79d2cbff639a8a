// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "header_words.h"

#include <algorithm>

namespace pcl_bv {

std::string read_start(const InputFile& file) {
  std::string start(std::min(file.size(), max_header_size), '\0');
  file.read(0, start.data(), start.size());
  return start;
}

Words split(std::string_view line) {
  constexpr std::string_view blanks = " \t\r\v\f";
  Words words;
  std::size_t begin = line.find_first_not_of(blanks);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return words;
}

bool is_word(std::string_view text) {
  return !text.empty() && text.find_first_of(" \t\r\n\v\f") == std::string_view::npos;
}

}  // namespace pcl_bv
