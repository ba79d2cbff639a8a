// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// fit_bits FILE: fits every method to clouds that no machine computes otherwise and writes the bits of the
// volumes, so that processors can be compared: `./bootstrap check` does so with x86-64 and Arm.

#include <fstream>
#include <string>
#include <vector>

#include "directions.h"
#include "numbers.h"
#include "pcl_bv/fitting/methods.h"
#include "portable_clouds.h"

namespace pcl_bv {
namespace {

std::shared_ptr<const KdopSet> own_set() {
  std::vector<Eigen::Vector3d> directions;
  for (const auto& all : {test::nasty_directions(), test::integer_directions()}) {
    for (const auto& d : all)
      if (directions.size() < KdopSet::max_size) directions.emplace_back(d[0], d[1], d[2]);
  }
  return std::make_shared<const KdopSet>(directions);
}

template <typename T>
void write_own_kdop(std::ostream& out, const test::TestCloud<T>& cloud) {
  Kdop kdop;
  SlabPoints touching;
  fit_kdop(cloud.view(), own_set(), kdop, touching);
  out << "own directions, " << (sizeof(T) == 4 ? "float, " : "double, ") << cloud.name << ":";
  for (const std::uint64_t number : test::bits(kdop))
    out << ' ' << std::hex << number << std::dec;
  for (const auto& indices : {touching.min, touching.max}) {
    for (const std::size_t index : indices)
      out << ' ' << index;
  }
  out << '\n';
}

template <typename T>
void write(std::ostream& out) {
  for (const test::TestCloud<T>& cloud : test::portable_clouds<T>()) {
    write_own_kdop(out, cloud);
    for (const Method& method : methods()) {
      AnyVolume volume;
      method.fit(cloud.view(), volume, {});
      out << method.name << ", " << (sizeof(T) == 4 ? "float, " : "double, ") << cloud.name << ":";
      for (const std::uint64_t number : test::bits(volume))
        out << ' ' << std::hex << number << std::dec;
      out << '\n';
    }
  }
}

}  // namespace
}  // namespace pcl_bv

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ofstream out(argv[1]);
  pcl_bv::write<float>(out);
  pcl_bv::write<double>(out);
  return out.flush() ? 0 : 1;
}
