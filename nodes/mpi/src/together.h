// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One cloud over all ranks.
#pragma once

#include <cstddef>

#include "commands/pcd_bv/options.h"
#include "commands/pcd_bv/status.h"
#include "commands/pcd_bv/tiles.h"
#include "pcl_bv/report/report.h"
#include "ranks.h"

namespace pcl_bv {

/// Fits each method to all points: those that partial results serve, to what all ranks have merged; the
/// smallest sphere by rounds of questions; those that need all points on a rank each, which passes over all.
/// An input that fails on any rank is left out by all of them, and the cloud is begun again without it. The
/// first rank gets the report, without a file, and the status; it throws IoError if no input can be read, as
/// all do.
Status fit_together(Ranks& ranks, Tiles& tiles, const Options& options, Report& report);

}  // namespace pcl_bv
