// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tilesets of 3D Tiles. Their contents are files, which a fuzzer does not have, so no tile gets a new volume.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "memory_file.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/report/tileset.h"

namespace pcl_bv {

Fitted<AnyVolume> Method::fit(const PointView& /*points*/, const MethodOptions& /*options*/,
                              const Execution& /*execution*/) const {
  std::abort();
}

Certified<Sphere, SphereCertificate> fit_smallest_sphere(const PointView& /*points*/,
                                                         const Execution& /*execution*/) {
  std::abort();
}

}  // namespace pcl_bv

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  static MemoryFile memory;
  memory.assign({reinterpret_cast<const char*>(data), size});
  try {
    if (update_tileset(memory.path(), {}, Execution{Serial{}}).updated != 0) std::abort();
  } catch (const IoError&) {
  }
  return 0;
}
