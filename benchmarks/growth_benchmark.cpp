// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How the cost grows from a thousand points to 32 million, on one core, and how fast the same bytes can be
// read. Rows as in rows.h.

#include "rows.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

void add_size(std::size_t points) {
  const CloudName name{"gauss", points};
  add_reading(name, 1);
  if (points > kL1) add_reading(name, 2);
  add_fits({"aabb", "dop26"}, usable_isas(), name);
  add_fits({"dop14", "sphere-epos26", "sphere-exact"}, {usable_isas().back()}, name);
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  for (std::size_t points = 1024; points <= std::size_t{1} << 24; points *= 4)
    pcl_bv::bench::add_size(points);
  pcl_bv::bench::add_size(std::size_t{1} << 25);
  return pcl_bv::bench::run_program(argc, argv);
}
