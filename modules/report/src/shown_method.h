// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>

#include "pcl_bv/report/report.h"

namespace pcl_bv {

/// The method; of `best` also the shape that it has chosen: "best (obb)".
inline std::string shown_method(const VolumeEntry& entry) {
  if (entry.method != "best" || empty(entry.volume)) return entry.method;
  return entry.method + " (" + std::string(shape_name(entry.volume)) + ')';
}

}  // namespace pcl_bv
