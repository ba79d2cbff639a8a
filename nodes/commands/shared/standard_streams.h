// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Handles a standard output that has no reader any more, whose disk is full, or that the caller has closed.
#pragma once

#include <string_view>

namespace pcl_bv::detail {

/// Must be called before any file is opened. Afterwards, write() reports a closed pipe as an error, and no
/// file gets the descriptor of a standard stream that the caller has closed.
void prepare_standard_streams();

/// Writes to standard output. Returns false if standard output has no reader any more. Throws IoError for any
/// other failure.
bool write_standard_output(std::string_view text);

}  // namespace pcl_bv::detail
