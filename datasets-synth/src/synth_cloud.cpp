// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Conversion of a synthetic cloud to a RawCloud.
#include "pcl_bv/synth/synth_cloud.h"

#include "pcl_bv/io/raw_cloud_edit.h"

namespace pcl_bv {
using namespace detail;

RawCloud to_raw_cloud(const SynthCloud& cloud) {
  RawCloud raw = make_cloud(cloud.xyz);
  if (!cloud.object.empty()) set_uint32_field(raw, "object", cloud.object);
  if (!cloud.ground.empty()) set_uint32_field(raw, "ground", cloud.ground);
  if (!cloud.vegetation.empty()) set_uint32_field(raw, "vegetation", cloud.vegetation);
  if (!cloud.kind.empty()) set_uint32_field(raw, "class", cloud.kind);
  raw.height = cloud.height;
  raw.width = cloud.size() / cloud.height;
  return raw;
}

}  // namespace pcl_bv
