// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits volumes to a cloud whose parts are on many machines or in many files. Each part is sent as a short
// message.
#include <pcl_bv/fitting/methods.h>
#include <pcl_bv/fitting/partial.h>

#include <iostream>
#include <random>
#include <vector>

int main() {
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  std::vector<float> xyz(3 * 60'000);
  for (float& coordinate : xyz) coordinate = normal(random);
  const pcl_bv::PointView whole = pcl_bv::PointView::of(xyz.data(), 3 * sizeof(float), xyz.size() / 3);

  pcl_bv::Partial all;
  for (std::size_t first = 0; first < whole.count; first += 20'000) {
    const pcl_bv::Partial part(whole.slice(first, 20'000));  // on the machine that has the part
    const std::vector<std::byte> message = part.to_bytes();  // a few kilobytes
    // The next line runs on the machine that fits the volumes. Messages may arrive in any order.
    all.merge(pcl_bv::Partial::from_bytes(message.data(), message.size()));
    std::cout << "a part of 20000 points: " << message.size() << " bytes\n";
  }
  const pcl_bv::Method& method = *pcl_bv::find_method("obb-min");
  const pcl_bv::AnyVolume from_parts = *all.fit(method), at_once = *method.fit(whole);
  std::cout << "volume " << pcl_bv::volume(from_parts)
            << " m3, equal to the fit of the whole cloud: " << std::boolalpha << (from_parts == at_once) << "\n";
  return from_parts == at_once ? 0 : 1;
}
