// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Source, runner and sinks, put together.
#pragma once

#include <atomic>

#include "options.h"

namespace pcl_bv {

/// Streams until the source ends or `interrupted`, then does what waits and writes the statistics. Returns
/// the exit status: 0, or 1 if an output could not be written or no frame could be read. A line on standard
/// error for each problem. Throws IoError if there is no source or a sink cannot be opened, UsageError if its
/// name means nothing.
int stream(const StreamOptions& options, const std::atomic<bool>& interrupted);

}  // namespace pcl_bv
