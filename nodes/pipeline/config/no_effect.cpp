// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds settings that have no effect in combination with the others, so that users do not search for the
// effect in the results.

#include <algorithm>
#include <limits>

#include "pcl_bv/nodes/pipeline_config.h"

namespace pcl_bv {
namespace {

bool is_upright_box(const Method* method) {
  return method->upright && method->shape == "obb";
}

bool is_prism(const Method* method) {
  return method->shape == "prism";
}

bool is_growing_sphere(const Method* method) {
  return method->shape == "sphere" && method->needs_all_points;
}

}  // namespace

std::vector<std::string> PipelineConfig::ineffective_settings(const SettingName& name) const {
  std::vector<std::string> lines;
  const auto check = [&](const char* key, bool set, bool useful, const std::string& needed) {
    if (set && !useful) lines.push_back(name(key) + ": has no effect without " + needed);
  };
  const std::vector<const Method*> all = methods();
  const bool upright = std::any_of(all.begin(), all.end(), is_upright_box),
             sphere = std::any_of(all.begin(), all.end(), is_growing_sphere),
             prism = std::any_of(all.begin(), all.end(), is_prism);
  check("track.smooth", track.smooth, track.enabled, name("track.enabled"));
  check("track.grow", track.grow, track.enabled, name("track.enabled"));
  check("track.smooth", track.smooth && track.enabled, upright, "an upright box, obb-yaw or obb-lshape");
  check("track.grow", track.grow && track.enabled, upright, "an upright box, obb-yaw or obb-lshape");
  check("growth", growth != SphereGrowth::deferred, sphere,
        "a sphere that grows, sphere-ritter or sphere-epos*");
  check("concave_length", concave_length.has_value(), prism, "prism");
  const bool limited = cluster.max_size < std::numeric_limits<std::size_t>::max() ||
                       std::any_of(cluster.classes.begin(), cluster.classes.end(),
                                   [](const ClassConfig& own) { return own.max_size.has_value(); });
  check("cluster.oversized", cluster.oversized != Oversized::drop, limited, name("cluster.max_size"));
  check("cluster.refine", cluster.refine == Refine::neck || cluster.refine == Refine::tracks,
        cluster.tolerance > 0, name("cluster.tolerance"));
  check("deskew", deskew == Deskew::on, ground.method != GroundMethod::none || cluster.tolerance > 0,
        name("ground.method") + " or " + name("cluster.tolerance"));
  const bool grounded = ground.method != GroundMethod::none;
  const std::string method = name("ground.method");
  check("ground.sensor", ground.sensor.has_value(),
        ground.method == GroundMethod::zones || track.enabled,  // tracks need the place for occlusions
        method + " zones");
  check("ground.sensor_height", ground.sensor_height.has_value(),
        ground.method == GroundMethod::zones || ground.method == GroundMethod::plane,
        grounded ? method + " zones or plane" : method);
  check("ground.cell_size", ground.cell_size.has_value(), ground.method == GroundMethod::slope,
        method + " slope");
  check("ground.distance", ground.distance.has_value(), grounded, method);
  check("ground.max_slope_degrees", ground.max_slope_degrees.has_value(), grounded, method);
  return lines;
}

}  // namespace pcl_bv
