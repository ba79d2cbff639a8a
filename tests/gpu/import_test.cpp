// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Memory that another program exports, played by a second open device.

#include <unistd.h>

#include <cstring>
#include <vector>

#include "clouds.h"
#include "gpu_context.h"
#include "gpu_test.h"
#include "pcl_bv/gpu/gpu_tree.h"

namespace pcl_bv {
namespace {

// Memory of its own device, with an opaque handle for others.
class Exporter {
 public:
  explicit Exporter(std::size_t bytes) : device_("0"), vk_(device_.context()->vk) {
    const VkDevice device = device_.context()->device;
    auto exported =
        detail::vulkan_struct<VkExportMemoryAllocateInfo>(VK_STRUCTURE_TYPE_EXPORT_MEMORY_ALLOCATE_INFO);
    exported.handleTypes = VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT;
    auto info = detail::vulkan_struct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.pNext = &exported;
    info.allocationSize = bytes;
    info.memoryTypeIndex = device_.context()->memory_type(
        ~0U, {VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT});
    EXPECT_EQ(vk_.vkAllocateMemory(device, &info, nullptr, &memory_), VK_SUCCESS);
    void* address = nullptr;
    EXPECT_EQ(vk_.vkMapMemory(device, memory_, 0, VK_WHOLE_SIZE, 0, &address), VK_SUCCESS);
    mapped = static_cast<std::byte*>(address);
  }
  ~Exporter() { vk_.vkFreeMemory(device_.context()->device, memory_, nullptr); }
  Exporter(const Exporter&) = delete;
  Exporter& operator=(const Exporter&) = delete;

  int handle() const {
    const auto get = reinterpret_cast<PFN_vkGetMemoryFdKHR>(
        vk_.vkGetDeviceProcAddr(device_.context()->device, "vkGetMemoryFdKHR"));
    auto info = detail::vulkan_struct<VkMemoryGetFdInfoKHR>(VK_STRUCTURE_TYPE_MEMORY_GET_FD_INFO_KHR);
    info.memory = memory_;
    info.handleType = VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT;
    int fd = -1;
    EXPECT_EQ(get(device_.context()->device, &info, &fd), VK_SUCCESS);
    return fd;
  }

  std::byte* mapped = nullptr;

 private:
  GpuDevice device_;
  detail::VulkanApi& vk_;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
};

TEST(ImportedCloud, HasTheBitsOfTheProcessorForRecordsAtAnyOffset) {
  PCL_BV_NEEDS_DEVICE();
  if (!test::small_buffers().info().imports) GTEST_SKIP() << "the driver cannot import memory";
  const test::TestCloud<float> points = test::gaussian<float>(100'000, 4, 10, 1e4);
  const std::vector<const Method*> methods = test::methods_named({"aabb", "dop26", "sphere-epos26"});
  const std::vector<Fitted<AnyVolume>> expected = fit_methods(points.view(), methods);
  for (const auto& [offset, stride] :
       std::vector<std::pair<std::size_t, std::size_t>>{{0, 12}, {20, 16}, {4, 48}}) {
    SCOPED_TRACE(testing::Message() << "offset " << offset << ", stride " << stride);
    const std::size_t bytes = (offset + points.size() * stride + 65535) / 65536 * 65536;
    const Exporter exporter(bytes);
    for (std::size_t i = 0; i < points.size(); ++i)
      std::memcpy(exporter.mapped + offset + i * stride, &points.xyz[3 * i], 12);
    const GpuCloud cloud = GpuCloud::import_memory(test::small_buffers(), exporter.handle(),
                                                   {bytes, offset, stride, points.size()});
    test::expect_same(fit(cloud, methods), expected, methods);
  }
}

TEST(ImportedCloud, SeesWhatTheExporterWritesBetweenFits) {
  PCL_BV_NEEDS_DEVICE();
  if (!test::small_buffers().info().imports) GTEST_SKIP() << "the driver cannot import memory";
  constexpr std::size_t bytes = 1 << 16;
  const std::vector<const Method*> methods = test::methods_named({"aabb", "dop14"});
  const Exporter exporter(bytes);
  const auto write = [&](const test::TestCloud<float>& points) {
    std::memcpy(exporter.mapped, points.xyz.data(), 12 * points.size());
  };
  write(test::gaussian<float>(5000, 1));
  const GpuCloud cloud =
      GpuCloud::import_memory(test::small_buffers(), exporter.handle(), {bytes, 0, 12, 5000});
  for (const std::uint64_t seed : {1, 2}) {
    const test::TestCloud<float> points = test::gaussian<float>(5000, seed, 7, 100);
    write(points);
    test::expect_same(fit(cloud, methods), fit_methods(points.view(), methods), methods);
  }
}

TEST(ImportedCloud, HasTreesThatFollowWhatTheExporterWrites) {
  PCL_BV_NEEDS_DEVICE();
  if (!test::small_buffers().info().imports) GTEST_SKIP() << "the driver cannot import memory";
  constexpr std::size_t bytes = 3 << 16, stride = 28, offset = 8, count = 5000;
  const test::TestCloud<float> queries = test::gaussian<float>(500, 3, 7, 100);
  const Exporter exporter(bytes);
  const auto write = [&](const test::TestCloud<float>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      std::memcpy(exporter.mapped + offset + i * stride, &points.xyz[3 * i], 12);
  };
  write(test::gaussian<float>(count, 1));
  const GpuCloud cloud =
      GpuCloud::import_memory(test::small_buffers(), exporter.handle(), {bytes, offset, stride, count});
  GpuTree tree(cloud);
  for (const std::uint64_t seed : {1, 2}) {
    const test::TestCloud<float> points = test::gaussian<float>(count, seed, 7, 100);
    write(points);
    tree.refit(cloud);
    std::vector<Neighbor> found, expected;
    nearest(tree, queries.view(), found);
    nearest(PointTree(points.view()), queries.view(), expected);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].index, expected[i].index) << i;
      EXPECT_EQ(found[i].squared_distance, expected[i].squared_distance) << i;
    }
  }
}

}  // namespace
}  // namespace pcl_bv
