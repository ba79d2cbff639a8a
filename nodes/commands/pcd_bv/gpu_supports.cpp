// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "gpu_supports.h"

#include "commands/shared/messages.h"
#include "pcl_bv/gpu/cluster_supports.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

std::string line_of(const GpuInfo& device) {
  return "  " + std::to_string(device.number) + ' ' + device.name + " (" +
         std::string(gpu_kind_name(device.kind)) + ", " + std::to_string(device.memory >> 20) + " MiB)\n";
}

// With --gpu auto, a device that fails only costs time.
class OptionalSupports : public ClusterSupports {
 public:
  using ClusterSupports::ClusterSupports;

  void find(const std::vector<PointView>& views, DirectionSet set, const Execution& execution) override {
    try {
      ClusterSupports::find(views, set, execution);
    } catch (const GpuError& error) {
      report_problem(std::string("--gpu auto: ") + error.what() + "; fits on the processor instead");
      forget();
    }
  }
};

}  // namespace

std::string gpu_list() {
  try {
    std::string text;
    for (const GpuInfo& device : gpu_devices())
      text += line_of(device);
    return text.empty() ? "graphics cards: none\n" : "graphics cards:\n" + text;
  } catch (const GpuError& error) {
    return std::string("graphics cards: none (") + error.what() + ")\n";
  }
}

MakeSupportFinder open_gpu(const std::string& which) {
  const bool optional = which == "auto";
  try {
    return [optional, device = GpuDevice(which)]() -> std::shared_ptr<SupportFinder> {
      if (optional) return std::make_shared<OptionalSupports>(device);
      return std::make_shared<ClusterSupports>(device);
    };
  } catch (const GpuError& error) {
    if (!optional) throw IoError(std::string("--gpu: ") + error.what());
    report_problem(std::string("--gpu auto: ") + error.what() + "; fits on the processor instead");
    return [] { return nullptr; };
  }
}

}  // namespace pcl_bv::detail
