// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "options.h"
#include "status.h"

namespace pcl_bv::detail {

/// Updates the bounding volumes of all inputs (--update), and prints a line for each on standard output.
/// Tiles and files that cannot be updated are reported on standard error, and the status is Status::failed.
Status update_tilesets(const Options& options);

}  // namespace pcl_bv::detail
