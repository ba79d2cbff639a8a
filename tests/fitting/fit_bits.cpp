// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// fit_bits FILE: fits every method to clouds that no machine computes otherwise and writes the bits of the
// volumes, so that processors can be compared: `./bootstrap check` does so with x86-64 and Arm.

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "clouds.h"
#include "directions.h"
#include "fits.h"
#include "numbers.h"
#include "pcl_bv/fitting/methods.h"

namespace pcl_bv::detail {
namespace {

// Only the generator's integers, sums, products, quotients and roots: std::normal_distribution takes
// logarithms, which libraries round differently.
class Portable {
 public:
  explicit Portable(std::uint64_t seed) : random_(seed) {}

  // A multiple of 2^-24 in (-2, 2), near 0 mostly.
  double bell() {
    double sum = -2;
    for (int i = 0; i < 4; ++i)
      sum += static_cast<double>(random_() >> 40) * 0x1p-24;
    return sum;
  }

  template <typename T>
  std::vector<T> ball(std::size_t n, double scale, double offset) {
    std::vector<T> xyz;
    while (xyz.size() < 3 * n)
      xyz.push_back(static_cast<T>(offset + scale * bell()));
    return xyz;
  }

  template <typename T>
  std::vector<T> sphere(std::size_t n) {
    std::vector<T> xyz;
    while (xyz.size() < 3 * n) {
      const double x = bell(), y = bell(), z = bell() + 0x1p-30;
      const double length = std::sqrt(x * x + y * y + z * z);
      for (const double c : {x, y, z})
        xyz.push_back(static_cast<T>(c / length));
    }
    return xyz;
  }

 private:
  std::mt19937_64 random_;
};

template <typename T>
std::vector<test::TestCloud<T>> clouds() {
  std::vector<test::TestCloud<T>> all;
  for (const std::size_t n : {1, 2, 3, 4, 5, 17, 300, 1025, 5000}) {
    Portable random(n);
    all.push_back({"ball of " + std::to_string(n), random.ball<T>(n, 1, 0)});
    all.push_back({"sphere of " + std::to_string(n), random.sphere<T>(n)});
  }
  Portable random(1);
  all.push_back({"UTM size", random.ball<T>(3000, 20, 5e6)});
  all.push_back({"a millimetre at 1", random.ball<T>(3000, 1e-3, 1)});
  all.push_back({"scale 1e-41", random.ball<T>(3000, 1e-41, 0)});
  all.push_back({"scale 1e-20", random.ball<T>(3000, 1e-20, 0)});
  all.push_back({"scale 1e20", random.ball<T>(3000, 1e20, 0)});
  all.push_back({"scale 1e37", random.ball<T>(3000, 1e37, 0)});
  test::TestCloud<T> flat{"tilted plane", random.ball<T>(3000, 1, 0)},
      holed{"NaN", random.ball<T>(3000, 1, 0)};
  for (std::size_t i = 0; i < 3000; ++i) {
    flat.xyz[3 * i + 2] = flat.xyz[3 * i];
    if (i % 7 == 3) holed.xyz[3 * i + i % 3] = std::numeric_limits<T>::quiet_NaN();
  }
  all.insert(all.end(), {flat, holed});
  return all;
}

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
  test::take(fit_kdop_with_contacts(cloud.view(), own_set()), kdop, touching);
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
  for (const test::TestCloud<T>& cloud : clouds<T>()) {
    write_own_kdop(out, cloud);
    for (const Method& method : methods()) {
      AnyVolume volume = *method.fit(cloud.view());
      out << method.name << ", " << (sizeof(T) == 4 ? "float, " : "double, ") << cloud.name << ":";
      for (const std::uint64_t number : test::bits(volume))
        out << ' ' << std::hex << number << std::dec;
      out << '\n';
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ofstream out(argv[1]);
  pcl_bv::detail::write<float>(out);
  pcl_bv::detail::write<double>(out);
  return out.flush() ? 0 : 1;
}
