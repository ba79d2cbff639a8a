// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as a file of the ground, and as the bounds and cells of a file with right check sums.
#include <boost/crc.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "memory_file.h"
#include "pcl_bv/report/ground_file.h"

namespace {

using namespace pcl_bv;
using namespace pcl_bv::detail;

void require(bool holds, const char* rule) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", rule);
  std::abort();
}

std::string with_check_sum(std::string bytes) {
  boost::crc_32_type sum;
  sum.process_bytes(bytes.data(), bytes.size());
  const std::uint32_t value = sum.checksum();
  return bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Returns a file with the bounds and cells of the input.
std::string repaired(std::string_view content) {
  if (content.size() < sizeof(GroundBounds)) return {};
  const std::string_view bounds = content.substr(0, sizeof(GroundBounds));
  content.remove_prefix(bounds.size());
  content = content.substr(0, content.size() / sizeof(LowestPoint) * sizeof(LowestPoint));
  const std::string options = "o", cloud = partial_file_content({});
  const std::uint64_t counts[] = {options.size(), cloud.size(), content.size() / sizeof(LowestPoint)};
  std::string header = "pcl_bv ground 1\n";
  header.resize(24);
  header.append(reinterpret_cast<const char*>(counts), sizeof counts).append(bounds);
  return with_check_sum(header + options + cloud) + with_check_sum(std::string(content));
}

void check(std::string_view content) {
  static MemoryFile memory;
  memory.assign(content);
  try {
    const GroundFile file(memory.path());
    const GroundBounds bounds = file.bounds();
    const GroundSlopeOptions options;
    LowestPoints lowest(options), all(options);
    file.read(cells_that_matter({0, 0, 3, 3}, bounds.lowest, bounds.highest, options), lowest);
    constexpr std::int32_t min = std::numeric_limits<std::int32_t>::min(),
                           max = std::numeric_limits<std::int32_t>::max();
    file.read({min, min, max, max}, all);
    require(lowest.size() <= all.size(), "a range has no more cells than the file");
    for (std::size_t i = 0; i < all.size(); ++i)
      require(bounds.contain(all[i]), "cells are in their bounds");
    const std::size_t cells = all.size();
    require(SlopeSurface(std::move(all), {Serial{}, UsableIsa(Isa::automatic)}).cell_count() == cells,
            "a surface has all cells");
  } catch (const IoError& error) {
    require(std::string_view(error.what()).size() < 200, "a reason is short");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  check(content);
  check(repaired(content));
  return 0;
}
