// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The fields of rows. A row is an element of a list in the configuration, namely a region, a
// class or a sensor.
#pragma once

#include <concepts>
#include <type_traits>

#include "settings.h"

namespace pcl_bv::detail {

/// Element types of the lists in the configuration.
template <typename T>
concept ConfigRow =
    std::same_as<T, RegionConfig> || std::same_as<T, ClassConfig> || std::same_as<T, RigSensor>;

/// How messages name a row.
struct RowNames {
  const char *one, *many, *example;
};
template <ConfigRow Row>
constexpr RowNames row_names() {
  if constexpr (std::is_same_v<Row, RegionConfig>)
    return {"a region", "regions", "{file: F.json, keep: false, padding: 0}"};
  if constexpr (std::is_same_v<Row, RigSensor>)
    return {"a sensor", "sensors", "{topic: /points, frame: lidar}"};
  return {"a class", "classes", "{value: 4, tolerance: 0.5}"};
}

constexpr double kMaxPadding = 1e100;  // metres

/// Calls visit(setting, value) for each field of a row, as visit_stream() does for settings.
template <typename Row, typename Visit>
void visit_row(Row& row, Visit&& visit) {
  using S = Setting;
  if constexpr (std::is_same_v<std::remove_const_t<Row>, RegionConfig>) {
    visit(S{"file", "", ""}, row.file);
    visit(S{"keep", "", ""}, row.keep);
    visit(S{"padding", "m", "", {0, kMaxPadding}}, row.padding);
  } else if constexpr (std::is_same_v<std::remove_const_t<Row>, RigSensor>) {
    visit(S{"topic", "", ""}, row.topic);
    visit(S{"frame", "", ""}, row.frame);
    visit(S{"pose", "m, radians", ""}, row.pose);
    visit(S{"source", "", ""}, row.source);
  } else {
    visit(S{"value", "", ""}, row.value);
    visit(S{"drop", "", ""}, row.drop);
    visit(S{"tolerance", "m", "", {0, 1e6, false, true}}, row.tolerance);
    visit(S{"min_size", "points", "", {0, kNoLimit}}, row.min_size);
    visit(S{"max_size", "points", "", {1, kNoLimit}}, row.max_size);
    visit(S{"volumes", "methods", ""}, row.volumes);
    visit(S{"name", "", ""}, row.name);
  }
}

}  // namespace pcl_bv::detail
