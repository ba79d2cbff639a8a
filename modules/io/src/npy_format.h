// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The header of NumPy's arrays.
#pragma once

#include <string_view>

#include "pcd_format.h"

namespace pcl_bv::detail {

struct NpyHeader {
  PcdHeader records;       ///< The array as a binary .pcd. With `by_column`, only its description.
  bool by_column = false;  ///< Whether all x come first, then all y and so on (Fortran's order).
};

/// Parses the header at the beginning of `start`. Throws IoError if there is no valid header in it.
NpyHeader parse_npy_header(std::string_view start);

/// Reads the header of a file. Throws IoError, also if the array is longer than the file.
NpyHeader read_npy_header(const InputFile& file);

/// Reads the points behind the header. The cloud of an .npz file is read from memory, `bytes`.
void read_npy_points(const InputFile& file, NpyHeader& header);
void read_npy_points(std::string_view bytes, NpyHeader& header);

}  // namespace pcl_bv::detail
