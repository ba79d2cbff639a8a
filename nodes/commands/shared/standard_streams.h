// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Standard output as what it may be: a pipe whose reader leaves, a full disk, or closed from the start.
#pragma once

#include <string_view>

namespace pcl_bv {

/// To be called before anything is opened. A closed pipe becomes an error of write(), seen where it happens,
/// and no file of ours gets the number of a standard stream that the caller has closed.
void prepare_standard_streams();

/// Writes to standard output; false if nobody reads any more. Throws IoError for any other failure.
bool write_standard_output(std::string_view text);

}  // namespace pcl_bv
