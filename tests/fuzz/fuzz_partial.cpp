// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as a file of partial results, and as the heading and the results between right check sums.
#include <boost/crc.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/report/partial_file.h"

namespace {

using namespace pcl_bv::detail;

std::string with_check_sum(std::string text) {
  boost::crc_32_type sum;
  sum.process_bytes(text.data(), text.size());
  const std::uint32_t value = sum.checksum();
  return text.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// What is read is written as it was, but for the form of the heading.
void check(std::string_view content) {
  try {
    const std::string again = merged_clouds_content(parse_merged_clouds(content));
    if (merged_clouds_content(parse_merged_clouds(again)) != again) std::abort();
  } catch (const pcl_bv::IoError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  check(content);
  const std::size_t line = content.find('\n');
  if (line == std::string_view::npos) return 0;
  const std::string heading(content.substr(0, line + 1)), results(content.substr(line + 1));
  check(with_check_sum("pcl_bv partial results 1\n" + heading + with_check_sum(results)));
  return 0;
}
