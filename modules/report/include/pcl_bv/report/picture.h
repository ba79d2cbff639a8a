// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A still picture of a cloud and its volumes, drawn without a display.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Labels of points that belong to no cluster.
inline constexpr std::uint32_t label_ground = 4294967294;
inline constexpr std::uint32_t label_none = 4294967295;

/// A volume and the number of its colour: that of the cluster of this id.
struct PictureVolume {
  AnyVolume volume;
  std::uint32_t colour = 0;
};

/// From where a picture is taken. All views are parallel; z is up in all but `top`.
enum class ViewFrom {
  iso,    ///< From above one corner of the scene.
  top,    ///< Down along z; x points right, y up.
  front,  ///< Along y; x points right.
  side    ///< Against x; y points right.
};

/// What to draw.
struct Picture {
  PointView points;  ///< The points to draw; those not finite, and dead beams at exactly 0,0,0, are left out.
  const std::uint32_t* labels =
      nullptr;                         ///< Cluster id of every point of the cloud, or null: colour by height.
  std::vector<PictureVolume> volumes;  ///< Empty ones are left out.
  int width = 1600;                    ///< Pixels.
  int height = 1000;
  ViewFrom from = ViewFrom::iso;
};

/// The picture as a PNG file in memory. Points of a cluster have its colour, others are grey. Same input,
/// same bytes.
///
/// What is far away does not shrink the scene: the frame holds the central 98 % of the points (of those in
/// clusters if there are labels) and the volumes, of 16 and more only the inner ones: up to a sixteenth are
/// left out at each side. Volumes without labels are framed alone. A picture of nothing is only background.
/// From 480 x 320 pixels on, the lower left corner shows the axes (x red, y green, z blue) and a scale bar
/// with its length in the points' unit. Throws std::invalid_argument for a side outside 16..16384.
std::string picture_png(const Picture& picture);

/// The same picture as an SVG file in memory: the points as one embedded PNG, the volumes as lines and areas
/// that stay sharp and can be edited.
std::string picture_svg(const Picture& picture);

/// Writes picture_svg() if the name ends in .svg, in any case, else picture_png(), as write_file_atomically()
/// does: after an IoError a file that was there before is untouched.
void write_picture(const std::filesystem::path& path, const Picture& picture);

}  // namespace pcl_bv
