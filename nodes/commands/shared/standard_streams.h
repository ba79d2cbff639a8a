// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Handles a standard output whose reader has gone, whose disk is full, or that is closed from the start.
#pragma once

#include <string_view>

namespace pcl_bv {

/// Must be called before any file is opened. Afterwards, write() reports a closed pipe as an error, and no
/// file gets the descriptor of a standard stream that the caller has closed.
void prepare_standard_streams();

/// Writes to standard output. Returns false if nobody reads it any more. Throws IoError for any other
/// failure.
bool write_standard_output(std::string_view text);

}  // namespace pcl_bv
