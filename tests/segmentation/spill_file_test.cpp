// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stored/spill_file.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdint>
#include <numeric>
#include <vector>

namespace pcl_bv::detail {
namespace {

TEST(SpillFile, HasTheBytesThatWereWrittenWhateverErrnoWasBefore) {
  SpillFile file("");
  std::vector<std::uint32_t> first(1000), second(3000);
  std::iota(first.begin(), first.end(), 1U);
  std::iota(second.begin(), second.end(), 5000U);
  for (const int before : {0, EINTR, ENOSPC}) {
    errno = before;
    const Extent a = file.append(first.data(), first.size() * sizeof first[0]);
    errno = before;
    const Extent b = file.append(second.data(), second.size() * sizeof second[0]);
    std::vector<std::uint32_t> found(first.size()), others(second.size());
    errno = before;
    file.read(a.offset, found.data(), a.bytes);
    errno = before;
    file.read(b.offset, others.data(), b.bytes);
    EXPECT_EQ(found, first) << before;
    EXPECT_EQ(others, second) << before;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
