// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// All stored numbers of a volume, to compare volumes bit by bit.
#pragma once

#include <bit>
#include <cstdint>
#include <variant>
#include <vector>

#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::test {

inline std::vector<double> numbers(const Aabb& box) {
  return {box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z()};
}

inline std::vector<double> numbers(const Kdop& kdop) {
  std::vector<double> all;
  for (std::size_t k = 0; k < kdop.size(); ++k)
    all.insert(all.end(), {kdop.min(k), kdop.max(k)});
  return all;
}

inline std::vector<double> numbers(const Sphere& sphere) {
  return {sphere.center().x(), sphere.center().y(), sphere.center().z(), sphere.radius()};
}

inline std::vector<double> numbers(const Obb& box) {
  std::vector<double> all(box.center().begin(), box.center().end());
  all.insert(all.end(), box.axes().data(), box.axes().data() + 9);
  all.insert(all.end(), box.half_extents().begin(), box.half_extents().end());
  return all;
}

inline std::vector<double> numbers(const AnyVolume& volume) {
  return std::visit([](const auto& shape) { return numbers(shape); }, volume);
}

/// Bits, not values: the centre of an empty sphere is NaN, and -0 is not 0.
inline std::vector<std::uint64_t> bits(const AnyVolume& volume) {
  std::vector<std::uint64_t> all;
  for (const double number : numbers(volume))
    all.push_back(std::bit_cast<std::uint64_t>(number));
  return all;
}

}  // namespace pcl_bv::test
