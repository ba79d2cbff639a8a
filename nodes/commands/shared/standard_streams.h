// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Handles a standard output that has no reader any more, whose disk is full, or that was closed when the
// program was started.
#pragma once

#include <string_view>

namespace pcl_bv::detail {

/// Must be called before any file is opened. Afterwards, writing to a closed pipe gives an error and does not
/// end the program. If the program was started with a standard stream closed, no file that is opened later
/// gets the descriptor of this stream.
void prepare_standard_streams();

/// Writes to standard output. Returns false if standard output has no reader any more. Throws IoError for any
/// other failure.
bool write_standard_output(std::string_view text);

}  // namespace pcl_bv::detail
