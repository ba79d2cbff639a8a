// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The device of the tests, and comparisons with fits by the processor.
#pragma once

#include <gtest/gtest.h>

#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "numbers.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/gpu/gpu_fit.h"

namespace pcl_bv::test {

/// Returns whether there is any device. If not, says so once: a machine without one skips these tests.
inline bool have_device() {
  static const bool have = [] {
    try {
      return !gpu_devices().empty();
    } catch (const GpuError& error) {
      std::cerr << "no device: " << error.what() << '\n';
      return false;
    }
  }();
  return have;
}

#define PCL_BV_NEEDS_DEVICE() \
  if (!test::have_device()) GTEST_SKIP() << "no device for Vulkan 1.1 (install mesa-vulkan-drivers)"

/// The first device, with the smallest buffers, so that clouds of 87 381 points have several parts.
inline const GpuDevice& small_buffers() {
  static const GpuDevice device("0", {false, std::size_t{1} << 20});
  return device;
}

/// The first device with the validation layer, or nothing if the layer is not installed.
inline std::optional<GpuDevice> validated_device() {
  try {
    return GpuDevice("0", {true, std::size_t{1} << 20});
  } catch (const GpuError& error) {
    std::cerr << "no validation layer: " << error.what() << '\n';
    return std::nullopt;
  }
}

#define PCL_BV_NEEDS_VALIDATION(device) \
  if (!(device)) GTEST_SKIP() << "no validation layer (install vulkan-validationlayers)"

inline std::vector<const Method*> methods_named(const std::vector<std::string>& names) {
  std::vector<const Method*> methods;
  for (const std::string& name : names)
    methods.push_back(find_method(name));
  return methods;
}

/// Expects the same bits in volume, status, rank and counts.
inline void expect_same(const std::vector<Fitted<AnyVolume>>& by_device,
                        const std::vector<Fitted<AnyVolume>>& expected,
                        const std::vector<const Method*>& methods) {
  ASSERT_EQ(by_device.size(), expected.size());
  for (std::size_t m = 0; m < expected.size(); ++m) {
    SCOPED_TRACE(methods[m]->name);
    EXPECT_EQ(by_device[m].status, expected[m].status);
    EXPECT_EQ(by_device[m].rank, expected[m].rank);
    EXPECT_EQ(by_device[m].used, expected[m].used);
    EXPECT_EQ(by_device[m].dropped, expected[m].dropped);
    EXPECT_EQ(bits(by_device[m].volume), bits(expected[m].volume));
  }
}

}  // namespace pcl_bv::test
