// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes of objects in the formats of data sets and labelling tools. read_volumes() reads all of them.
// docs/formats.md describes their frames and angles.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "pcl_bv/report/report.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

enum class BoxLabelFormat : std::uint8_t {
  kitti,           ///< A line per object: the labels of one frame of KITTI's object benchmark.
  kitti_tracking,  ///< As kitti, after the number of the frame and the id of the track (-1 without a track).
  nuscenes,        ///< JSON: the boxes of each input under its name, as in nuScenes' results of detection.
  openlabel,       ///< ASAM OpenLABEL 1.0.0.
  sustech          ///< JSON of SUSTechPOINTS: the labels of one frame.
};

/// The texts of a file before the first input, between two inputs, and after the last input.
struct BoxLabelFile {
  std::string_view begin, between, end;
};

BoxLabelFile box_label_file(BoxLabelFormat format);

struct BoxLabelOptions {
  /// Type of all objects. If it is empty, the type is the class of the points and, without classes, the word
  /// that the format has for unknown objects.
  std::string type{};
  /// Number of the frame, if the file has several frames. Needed by kitti_tracking.
  std::optional<std::size_t> frame{};
};

/// Writes a label for each cluster to `take`. A cluster's label is its first upright box, otherwise its first
/// oriented box, otherwise its first axis-aligned box. KITTI's labels have only a yaw, so oriented boxes that
/// are not upright are skipped there. A cluster without such a box has no label. Positions are in the frame
/// and unit of the points, in KITTI's formats in that of a camera at their origin (see docs/formats.md).
/// Centres and sizes are exact, except for the centre's height in KITTI's formats, which is rounded once.
/// Rotations are rounded to 1e-15. Writes nothing for a failed report.
void write_box_labels(const Report& report, const ClusterSource& clusters, BoxLabelFormat format,
                      const BoxLabelOptions& options, const TextSink& take);

}  // namespace detail
}  // namespace pcl_bv
