// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <random>

#include "files.h"
#include "laz_chunk_table.h"
#include "laz_table.h"

namespace pcl_bv::detail {
namespace {

class LazTable : public FileTest {
 protected:
  void expect_read_back(const std::vector<LazTableEntry>& entries, bool with_points, int run) const {
    write_text(file("table"), "before" + laz_table(entries, with_points));
    const InputFile bytes(file("table"));
    ChunkTableReader table(bytes, 6, with_points);
    ASSERT_EQ(table.size(), entries.size()) << run;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const ChunkTableReader::Entry entry = table.next();
      ASSERT_EQ(entry.bytes, entries[i].bytes) << "entry " << i << ", run " << run;
      ASSERT_EQ(entry.points, with_points ? entries[i].points : 0) << "entry " << i << ", run " << run;
    }
  }
};

// Numbers that differ by up to 2^0 ... 2^32, many enough that counts are halved.
TEST_F(LazTable, GivesTheNumbersThatWereEncoded) {
  std::mt19937 random(3);
  for (int run = 0; run < 66; ++run) {
    const std::uint32_t limit = run % 33 == 32 ? 0xFFFFFFFF : (1U << run % 33) - 1;
    std::vector<LazTableEntry> entries(run < 33 ? 3 : 20'000);
    for (LazTableEntry& entry : entries)
      entry = {static_cast<std::uint32_t>(random()) & limit,
               50'000 + (static_cast<std::uint32_t>(random()) & limit)};
    expect_read_back(entries, run % 2 == 0, run);
  }
}

TEST_F(LazTable, GivesTheGreatestDifferences) {
  std::vector<LazTableEntry> entries;
  for (const std::uint32_t value :
       {0U, 0x80000000U, 0U, 0x80000001U, 1U, 0xFFFFFFFFU, 0x7FFFFFFFU, 0U, 0U, 1U})
    entries.push_back({value, ~value});
  expect_read_back(entries, true, 0);
}

TEST_F(LazTable, CutAnywhereIsAnError) {
  const std::string whole = laz_table({{10, 200}, {3000, 40'000}, {500'000, 6'000'000}}, true);
  for (std::size_t size = 1; size + 8 < whole.size(); ++size) {  // the last bytes only end the coded numbers
    write_text(file("table"), whole.substr(0, size));
    const InputFile bytes(file("table"));
    const auto read_all = [&] {
      ChunkTableReader table(bytes, 0, true);
      for (std::uint32_t i = 0; i < table.size(); ++i)
        table.next();
    };
    EXPECT_THROW(read_all(), IoError) << size;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
