// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Failures of the driver, which the tests inject by replacing Vulkan's functions.

#include <atomic>

#include "clouds.h"
#include "gpu_context.h"
#include "gpu_test.h"
#include "pcl_bv/gpu/gpu_tree.h"

namespace pcl_bv {
namespace {

using test::TestCloud;

std::atomic<int> calls_before_failure = -1;
PFN_vkAllocateMemory real_allocate = nullptr;

// Fails once, after the given number of calls.
VkResult VKAPI_PTR failing_allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                    const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
  if (calls_before_failure-- == 0) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  return real_allocate(device, info, callbacks, memory);
}

VkResult VKAPI_PTR losing_submit(VkQueue, std::uint32_t, const VkSubmitInfo*, VkFence) {
  return VK_ERROR_DEVICE_LOST;
}

template <typename Call>
GpuFailure failure_of(const Call& call) {
  try {
    call();
  } catch (const GpuError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.failure();
  }
  ADD_FAILURE() << "no GpuError";
  return GpuFailure::other;
}

// A device whose allocations are counted. Its first fits allocate memory, which later ones use again.
GpuDevice failing_device() {
  GpuDevice device("0", {false, std::size_t{1} << 20});
  real_allocate = device.context()->vk.vkAllocateMemory;
  device.context()->vk.vkAllocateMemory = failing_allocate;
  return device;
}

// Makes each allocation of `call` fail in turn, with a device of its own each time, until `call` needs no
// more of them. How many it needs depends on the device: a cloud in mapped memory leaves no buffers to use
// again.
template <typename Prepare, typename Call, typename Check>
void fail_each_allocation(int at_least, const Prepare& prepare, const Call& call, const Check& check) {
  int allocations = 0;
  for (bool failed = true; failed; ++allocations) {
    ASSERT_LT(allocations, 100);
    SCOPED_TRACE(allocations);
    const GpuDevice device = failing_device();
    calls_before_failure = -1;
    const auto prepared = prepare(device);
    calls_before_failure = allocations;
    failed = false;
    try {
      call(prepared);
    } catch (const GpuError& error) {
      failed = true;
      ASSERT_EQ(error.failure(), GpuFailure::out_of_memory);
    }
    calls_before_failure = -1;
    check(prepared);
    EXPECT_FALSE(device.lost());
  }
  EXPECT_GT(allocations, at_least);
}

TEST(GpuFailure, TooLittleMemoryForACloudLeavesTheDeviceUsable) {
  PCL_BV_NEEDS_DEVICE();
  const GpuDevice device = failing_device();
  const TestCloud<float> points = test::gaussian<float>(200'000, 1);
  const std::vector<const Method*> methods = test::methods_named({"dop26"});
  for (int before = 0; before < 3; ++before) {
    SCOPED_TRACE(before);
    calls_before_failure = before;
    EXPECT_EQ(failure_of([&] { GpuCloud(device, points.view()); }), GpuFailure::out_of_memory);
  }
  calls_before_failure = -1;
  test::expect_same(fit(GpuCloud(device, points.view()), methods), fit_methods(points.view(), methods),
                    methods);
}

TEST(GpuFailure, TooLittleMemoryForAFitLeavesTheCloudUsable) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> points = test::gaussian<float>(200'000, 1);
  const std::vector<const Method*> methods = test::methods_named({"dop26", "sphere-epos26"});
  const std::vector<Fitted<AnyVolume>> expected = fit_methods(points.view(), methods);
  fail_each_allocation(
      3, [&](const GpuDevice& device) { return GpuCloud(device, points.view(), HostPoints::release); },
      [&](const GpuCloud& cloud) { fit(cloud, methods); },
      [&](const GpuCloud& cloud) { test::expect_same(fit(cloud, methods), expected, methods); });
}

TEST(GpuFailure, TooLittleMemoryForClustersLeavesTheCloudUsable) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> points = test::gaussian<float>(1000, 1);
  const std::vector<const Method*> methods = test::methods_named({"aabb"});
  const std::vector<std::size_t> offsets = {0, 400, 1000};
  fail_each_allocation(
      3, [&](const GpuDevice& device) { return GpuCloud(device, points.view()); },
      [&](const GpuCloud& cloud) { fit(cloud, offsets, methods); },
      [&](const GpuCloud& cloud) {
        test::expect_same({fit(cloud, offsets, methods).fitted(1, 0)},
                          fit_methods(points.view().slice(400, 600), methods), methods);
      });
}

TEST(GpuFailure, TooLittleMemoryForATreeLeavesTheCloudUsable) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> points = test::gaussian<float>(200'000, 1);
  fail_each_allocation(
      12, [&](const GpuDevice& device) { return GpuCloud(device, points.view()); },
      [](const GpuCloud& cloud) { GpuTree{cloud}; },
      [&](const GpuCloud& cloud) { EXPECT_EQ(GpuTree(cloud).size(), points.size()); });
}

TEST(GpuFailure, ALostDeviceStaysLost) {
  PCL_BV_NEEDS_DEVICE();
  const GpuDevice device("0");
  const TestCloud<float> points = test::gaussian<float>(3000, 1);
  const std::vector<const Method*> methods = test::methods_named({"aabb"});
  const GpuCloud cloud(device, points.view());
  const PFN_vkQueueSubmit real_submit = device.context()->vk.vkQueueSubmit;
  device.context()->vk.vkQueueSubmit = losing_submit;
  EXPECT_EQ(failure_of([&] { fit(cloud, methods); }), GpuFailure::lost);
  EXPECT_TRUE(device.lost());
  device.context()->vk.vkQueueSubmit = real_submit;
  EXPECT_EQ(failure_of([&] { fit(cloud, methods); }), GpuFailure::lost);
  EXPECT_EQ(failure_of([&] { GpuCloud(device, points.view()); }), GpuFailure::lost);
  // Another device of the same name is not affected.
  const GpuDevice other("0");
  test::expect_same(fit(GpuCloud(other, points.view()), methods), fit_methods(points.view(), methods),
                    methods);
}

TEST(GpuFailure, RefusesDoublesThatOnlyTheDeviceWouldHave) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<double> points = test::gaussian<double>(10, 1);
  EXPECT_THROW(GpuCloud(test::small_buffers(), points.view(), HostPoints::release), std::invalid_argument);
}

TEST(GpuFailure, RefusesImportedLayoutsOutsideTheirMemory) {
  PCL_BV_NEEDS_DEVICE();
  const auto import = [](const ImportedPoints& layout) {
    GpuCloud::import_memory(test::small_buffers(), -1, layout);
  };
  EXPECT_THROW(import({1200, 0, 12, 101}), std::invalid_argument);
  EXPECT_THROW(import({1200, 4, 12, 100}), std::invalid_argument);
  EXPECT_THROW(import({1200, 2, 12, 10}), std::invalid_argument);
  EXPECT_THROW(import({1200, 0, 8, 10}), std::invalid_argument);
  EXPECT_THROW(import({1200, 0, 14, 10}), std::invalid_argument);
  EXPECT_THROW(import({1200, 0, 2048, 1}), std::invalid_argument);
  EXPECT_EQ(failure_of([&] { import({1200, 0, 12, 100}); }), GpuFailure::other);  // -1 is no handle
}

}  // namespace
}  // namespace pcl_bv
