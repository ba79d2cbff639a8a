// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scores of tracks next to the labels of KITTI's tracking benchmark.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "kitti_labels.h"
#include "result_lines.h"
#include "track_score.h"

namespace pcl_bv::bench {

/// Which labels and boxes count. The rules are those of KITTI's benchmark as TrackEval applies them (Luiten
/// et al. 2021), with bird's-eye boxes instead of image boxes:
/// - Objects of `classes` are to be found, unless truncated > 0 or occluded > 2. All other labelled objects
/// may
///   be found: a box that is assigned to one of them does not count.
/// - A box without a partner does not count if more than half of its rectangle in the image is in a DontCare
///   rectangle, if this rectangle is at most 25 pixels high, or if its centre is not in the image. Labels
///   exist only there.
/// - pcl_bv finds every object, also trees and walls, and KITTI labels only road users. So a box without a
/// partner
///   that overlaps no object to be found does not count either, unless `count_unlabelled` is true.
struct KittiProtocol {
  std::set<std::string> classes{"Car", "Pedestrian", "Cyclist"};
  double min_iou = 0.3;  ///< Smallest bird's-eye IoU of a match for MOTA and MOTP.
  bool count_unlabelled = false;
};

/// Adds a sequence to `score`. Every frame counts from 0 to the last one of the labels and the results; a
/// frame without a line has no boxes. Throws std::runtime_error if two lines or two boxes are of one frame
/// and track.
void add_kitti_sequence(const std::vector<KittiObject>& labels, const KittiCalibration& calibration,
                        const std::vector<ResultFrame>& results, const KittiProtocol& protocol,
                        TrackScore& score);

}  // namespace pcl_bv::bench
