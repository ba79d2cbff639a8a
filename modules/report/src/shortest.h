// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>

namespace pcl_bv {

/// The fewest digits that read back as exactly this double; never -0. Throws std::domain_error if it is not
/// finite.
std::string shortest(double value);

}  // namespace pcl_bv
