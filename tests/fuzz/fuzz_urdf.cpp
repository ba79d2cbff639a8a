// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as a URDF: a robot whose shapes are where their links are, or one error.
#include <cstddef>
#include <cstdint>

#include "memory_file.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/io/raw_cloud.h"
#include "stream/rig/urdf.h"

namespace pcl_bv {

// Meshes are files, which a fuzzer does not have.
Fitted<Hull> fit_hull(const PointView& /*points*/, const Execution& /*execution*/) {
  return {};
}

}  // namespace pcl_bv

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  using namespace pcl_bv::detail;
  static MemoryFile memory;
  memory.assign({reinterpret_cast<const char*>(data), size});
  try {
    const Urdf urdf = read_urdf(memory.path());
    Transforms transforms;
    urdf.add_joints(transforms);
    std::vector<std::string> problems;
    for (const UrdfJoint& joint : urdf.joints) {
      static_cast<void>(urdf.volumes_in(joint.parent, problems));
      if (urdf.joints.size() > 8) break;  // quadratic
    }
  } catch (const IoError&) {
  }
  return 0;
}
