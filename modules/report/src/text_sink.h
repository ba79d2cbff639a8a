// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Helper functions for texts that are written in pieces.
#pragma once

#include <string>

#include "pcl_bv/report/report.h"

namespace pcl_bv::detail {

/// If the text has a megabyte or more, passes the text to `take` and clears the text.
inline void take_if_long(std::string& text, const TextSink& take) {
  if (text.size() < std::size_t{1} << 20) return;
  take(text);
  text.clear();
}

/// Returns a sink that appends each piece to `all`.
inline TextSink appended_to(std::string& all) {
  return [&all](std::string& piece) {
    if (all.empty()) {
      all.swap(piece);
    } else {
      all += piece;
    }
  };
}

}  // namespace pcl_bv::detail
