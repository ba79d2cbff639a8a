// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Texts to values that only this command has.
#pragma once

#include <string_view>

#include "options.h"

namespace pcl_bv {

/// All of these throw UsageError.
OriginOption parse_origin(std::string_view text);
OutputFormat parse_format(std::string_view text);
ViewFrom parse_view(std::string_view text);

}  // namespace pcl_bv
