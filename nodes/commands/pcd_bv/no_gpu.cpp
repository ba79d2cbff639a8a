// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// --gpu in builds without the component gpu.

#include "commands/shared/messages.h"
#include "gpu_supports.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

constexpr const char* kWithoutGpu =
    "this build has no support for graphics cards (it needs glslc and libvulkan-dev)";

}  // namespace

std::string gpu_list() {
  return std::string("graphics cards: none (") + kWithoutGpu + ")\n";
}

MakeSupportFinder open_gpu(const std::string& which) {
  if (which != "auto") throw IoError(std::string("--gpu: ") + kWithoutGpu);
  report_problem(std::string("--gpu auto: ") + kWithoutGpu + "; fits on the processor instead");
  return [] { return nullptr; };
}

}  // namespace pcl_bv::detail
