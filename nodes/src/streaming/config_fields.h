// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Every setting once: its key, its value, what is allowed and its unit. Reading, writing and checking a
// configuration are walks over this list.
#pragma once

#include <limits>

#include "pcl_bv/nodes/stream_config.h"

namespace pcl_bv {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();
inline constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

/// Numbers from `least` (itself only if `closed`) to `most`, both finite unless `most` may be infinite.
struct NumberRange {
  double least = 0;
  bool closed = true;
  double most = std::numeric_limits<double>::max();
};

template <typename Pipeline, typename Visitor>
void visit_pipeline(Pipeline& c, Visitor&& visit) {
  visit.number("filter.range_min", c.filter.range_min, NumberRange{}, "m");
  visit.number("filter.range_max", c.filter.range_max, NumberRange{0, true, kNoLimit}, "m");
  visit.optional_point("filter.own_box_min", c.filter.own_box_min, "m, [x, y, z]");
  visit.optional_point("filter.own_box_max", c.filter.own_box_max, "m, [x, y, z]");
  visit.choice("ground.method", c.ground.method, "none, plane, zones");
  visit.choice("ground.up", c.ground.up, "x, y, z, -x, -y, -z");
  visit.optional_number("ground.sensor_height", c.ground.sensor_height, NumberRange{}, "m");
  visit.optional_number("ground.distance", c.ground.distance, NumberRange{0, false},
                        "m; null: 0.2 of a plane, 0.15 of zones");
  visit.optional_number("ground.max_slope_degrees", c.ground.max_slope_degrees, NumberRange{0, true, 89},
                        "degrees; null: 15 of a plane, 20 of zones");
  visit.number("cluster.tolerance", c.cluster.tolerance, NumberRange{0, true, 1e6}, "m; 0: one cluster");
  visit.whole("cluster.min_size", c.cluster.min_size, 0, kUnlimited, "points");
  visit.whole("cluster.max_size", c.cluster.max_size, 1, kUnlimited, "points");
  visit.methods("volumes", c.volumes);
  visit.flag("track.enabled", c.track.enabled);
  visit.number("track.gate", c.track.gate, NumberRange{0, false, 100}, "m");
  visit.whole("track.birth", c.track.birth, 1, 1000, "frames");
  visit.whole("track.death", c.track.death, 1, 1000, "frames");
  visit.whole("threads", c.threads, 0, 1024, "0: all processors");
  visit.instruction_set("isa", c.isa);
}

template <typename Stream, typename Visitor>
void visit_stream(Stream& c, Visitor&& visit) {
  visit_pipeline(c.pipeline, visit);
  visit.whole("runner.queue", c.runner.queue, 1, 100'000, "frames");
  visit.choice("runner.policy", c.runner.policy, "auto, drop_oldest, drop_newest, block");
  visit.number("runner.max_age_ms", c.runner.max_age_ms, NumberRange{}, "ms; 0: any age");
  visit.number("runner.watchdog_s", c.runner.watchdog_s, NumberRange{}, "s; 0: none");
}

/// A value that is not allowed.
struct ConfigProblem {
  std::string key;
  std::string what;  ///< The value and what is allowed.
};

std::vector<ConfigProblem> problems_of(const PipelineConfig& config);
std::vector<ConfigProblem> problems_of(const StreamConfig& config);

std::string_view name_of(UpAxis axis);

/// The fewest digits that read back as exactly this double.
std::string digits_of(double value);

}  // namespace pcl_bv
