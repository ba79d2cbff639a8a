// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/gpu/gpu_device.h"

#include "device_choice.h"
#include "gpu_test.h"

namespace pcl_bv {
namespace {

std::vector<GpuInfo> three_devices() {
  return {{0, "llvmpipe (LLVM 15.0.6, 256 bits)", GpuKind::software, 1, 1, false},
          {1, "Intel(R) UHD Graphics", GpuKind::integrated, 1, 1, false},
          {2, "NVIDIA H100 PCIe", GpuKind::discrete, 1, 1, true}};
}

std::string refusal(const std::vector<GpuInfo>& devices, std::string_view which) {
  try {
    detail::choose_device(devices, which);
  } catch (const GpuError& error) {
    EXPECT_EQ(error.failure(), GpuFailure::no_device);
    return error.what();
  }
  return "nothing";
}

TEST(GpuDevice, AutoPrefersCardsOfTheirOwn) {
  std::vector<GpuInfo> devices = three_devices();
  EXPECT_EQ(detail::choose_device(devices, "auto"), 2U);
  devices.pop_back();
  EXPECT_EQ(detail::choose_device(devices, "auto"), 1U);
}

TEST(GpuDevice, AutoNeverChoosesASoftwareDriver) {
  EXPECT_EQ(refusal({three_devices()[0]}, "auto"),
            "no graphics card with Vulkan 1.1 was found (there are: 0 'llvmpipe (LLVM 15.0.6, 256 bits)')");
  EXPECT_EQ(refusal({}, "auto"), "no graphics card with Vulkan 1.1 was found (there is none)");
}

TEST(GpuDevice, IsChosenByNumberOrByAPartOfItsNameInAnyCase) {
  const std::vector<GpuInfo> devices = three_devices();
  EXPECT_EQ(detail::choose_device(devices, "1"), 1U);
  EXPECT_EQ(detail::choose_device(devices, "h100"), 2U);
  EXPECT_EQ(detail::choose_device(devices, "LLVMpipe"), 0U);
}

TEST(GpuDevice, AnAbsentOneIsRefusedWithTheOnesThereAre) {
  EXPECT_EQ(refusal({three_devices()[1]}, "radeon"),
            "no device for Vulkan is 'radeon' (there are: 1 'Intel(R) UHD Graphics')");
  // A number is not a part of a name.
  EXPECT_EQ(refusal({three_devices()[0]}, "15"),
            "no device for Vulkan is '15' (there are: 0 'llvmpipe (LLVM 15.0.6, 256 bits)')");
  EXPECT_EQ(refusal({}, ""), "no device for Vulkan is '' (there is none)");
}

TEST(GpuDevice, ListsWhatOpens) {
  PCL_BV_NEEDS_DEVICE();
  for (const GpuInfo& listed : gpu_devices()) {
    const GpuDevice device(std::to_string(listed.number));
    EXPECT_EQ(device.info().name, listed.name);
    EXPECT_GE(device.info().max_binding, std::size_t{128} << 20);  // what Vulkan 1.1 promises
    EXPECT_FALSE(device.lost());
  }
}

TEST(GpuDevice, RefusesBuffersThatAreTooSmall) {
  EXPECT_THROW(GpuDevice("0", {false, 1023}), std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv
