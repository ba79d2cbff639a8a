// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cairo.h>

#include "picture_view.h"

namespace pcl_bv {

/// Draws the axes that are not seen end-on and a scale bar, in the lower left corner. Nothing in pictures too
/// small for them, below 480 x 320.
void draw_marks(cairo_t* cairo, const View& view);

}  // namespace pcl_bv
