// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Layout of the boxes of a tree: that of BoxGroup (kernels/packed_tree.h), relative to the centre of the
// cloud.

const uint kWidth = 16;             // points of a packet, and boxes of a group
const uint kNone = 0xffffffffu;     // number of a slot without a point
const float kFar = 1e18;            // an empty box is from kFar to -kFar

// Returns the word of side 0 to 2 (low) or 3 to 5 (high) of a box.
uint box_word(uint group, uint side, uint box) {
  return (group * 6 + side) * kWidth + box;
}
