// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Connects a source, a runner and sinks.
#pragma once

#include <atomic>

#include "options.h"

namespace pcl_bv::detail {

/// Streams until the source ends, no sink takes results any more, or `interrupted` is set. Then processes the
/// queued frames and writes the statistics. Prints a line on standard error for each problem. Returns the
/// exit status: 0 on success; 1 if an output could not be written, the source failed, or all frames failed.
/// Throws IoError if the source or a sink cannot be opened, and UsageError if the name of the source or a
/// sink is invalid.
int stream(const StreamOptions& options, const std::atomic<bool>& interrupted);

}  // namespace pcl_bv::detail
