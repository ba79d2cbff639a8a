// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A still picture of a cloud and its volumes, drawn without a display.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Labels of points that belong to no cluster.
inline constexpr std::uint32_t label_ground = 4294967294;
inline constexpr std::uint32_t label_none = 4294967295;

/// A volume and how it is drawn.
struct PictureVolume {
  AnyVolume volume;
  std::uint32_t colour = 0;  ///< Its number: that of the cluster of this id.
  std::string label = {};    ///< Written above the volume in its colour; ASCII, other bytes become '?'.
  std::uint32_t method = 0;  ///< The index of its name in Picture::methods.
};

/// From where a picture is taken. All views are parallel. With z up the level axes are x and y; with another
/// `up` they are x as far as it is level (y if x is within 26 degrees of `up`), and what is 90 degrees to the
/// left of that, seen from above. A camera's frame, with y down, so has z as the second.
enum class ViewFrom {
  iso,    ///< From above one corner of the scene.
  top,    ///< Down; the first level axis points right, the second up.
  front,  ///< Along the second level axis; the first points right, `up` up.
  side    ///< Against the first level axis; the second points right, `up` up.
};

/// What to draw.
struct Picture {
  PointView points;  ///< The points to draw; those not finite, and dead beams at exactly 0,0,0, are left out.
  const std::uint32_t* labels =
      nullptr;                         ///< Cluster id of every point of the cloud, or null: colour by height.
  std::vector<PictureVolume> volumes;  ///< Empty ones are left out.
  std::vector<std::string> methods;    ///< Names for the legend; ASCII, as labels.
  std::string unit = "m";              ///< Of the points, beside the scale bar; may be empty.
  int width = 1600;                    ///< Pixels, at most.
  int height = 1000;
  ViewFrom from = ViewFrom::iso;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Of any length but 0.
};

/// The picture as a PNG file in memory. Points of a cluster have its colour, others are grey. Same input,
/// same bytes.
///
/// What is far away does not shrink the scene: the frame holds the central 98 % of the points (of those in
/// clusters if there are labels) and the volumes, of 16 and more only the inner ones: up to a sixteenth are
/// left out at each side. Volumes without labels are framed alone. A picture of nothing is only background.
///
/// From 480 x 320 pixels on, the lower left corner shows the axes (x red, y green, z blue) and a scale bar
/// with its length, the upper left one the names of the methods if several are drawn: in their colours if
/// each has its own, else with their dashes (six kinds, again and again). Labels are written at volumes whose
/// centre is in the picture, in the order given, but for those that would touch something written before.
/// `front` and `side` are as wide and high as what they show asks for, not below 480 x 320.
///
/// Throws std::invalid_argument for a side outside 16..16384, or an `up` that is zero or not finite.
std::string picture_png(const Picture& picture);

/// The same picture as an SVG file in memory: the points as one embedded PNG, the volumes as lines and areas
/// that stay sharp and can be edited.
std::string picture_svg(const Picture& picture);

/// Writes picture_svg() if the name ends in .svg, in any case, else picture_png(), as write_file_atomically()
/// does: after an IoError a file that was there before is untouched.
void write_picture(const std::filesystem::path& path, const Picture& picture);

}  // namespace pcl_bv
