// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The HTML page that shows frames.
#pragma once

#include <string_view>

namespace pcl_bv::detail {

/// Returns the page as one HTML file, which page/bundle.cmake assembles from the files in page/. The page
/// connects to the server that it was loaded from. To show one frame without a connection, replace the
/// text kPageData in the page by an element with the id "data" that contains this frame.
std::string_view live_page();

inline constexpr std::string_view kPageData = "<!-- data -->";

}  // namespace pcl_bv::detail
