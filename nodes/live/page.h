// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string_view>

namespace pcl_bv {

/// The page that shows frames, as one file of HTML: of page/, put together by page/bundle.cmake. It connects
/// to where it comes from, unless kPageData in it is replaced by an element with the id "data" that holds one
/// frame.
std::string_view live_page();

inline constexpr std::string_view kPageData = "<!-- data -->";

}  // namespace pcl_bv
