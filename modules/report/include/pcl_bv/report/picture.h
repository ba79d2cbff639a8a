// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Draws a picture of a cloud and its volumes, without a display.
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

/// Labels of points that belong to no cluster: ground, and all others.
inline constexpr std::uint32_t kLabelGround = 4294967294;
inline constexpr std::uint32_t kLabelNone = 4294967295;

/// A volume and how it is drawn.
struct PictureVolume {
  AnyVolume volume;
  std::uint32_t colour = 0;  ///< Number of the colour: the id of the volume's cluster.
  std::string label = {};    ///< Text above the volume in its colour; ASCII, other bytes become '?'.
  std::uint32_t method = 0;  ///< Index of its method in Picture::methods.
};

/// Directions of view; all projections are parallel. With z up, the horizontal axes are x and y. With another
/// `up`, the first horizontal axis is the projection of x onto the horizontal plane (of y if x is within 26
/// degrees of `up`), and the second one is 90 degrees to its left, seen from above. For example, in a
/// camera's frame (y down) the second horizontal axis is z.
enum class ViewFrom {
  iso,    ///< Obliquely from above, over a corner of the scene.
  top,    ///< Down; the first horizontal axis points right, the second up.
  front,  ///< Along the second horizontal axis; the first points right, `up` points up.
  side    ///< Against the first horizontal axis; the second points right, `up` points up.
};

/// The content of a picture.
struct Picture {
  PointView points;  ///< Points to draw. Non-finite points, and points at exactly 0,0,0, are left out.
  /// Cluster id of every point of the cloud, or null: colours by height.
  const std::uint32_t* labels = nullptr;
  std::vector<PictureVolume> volumes;  ///< Empty volumes are left out.
  std::vector<std::string> methods;    ///< Names for the legend; ASCII, other bytes become '?'.
  std::string unit = "m";              ///< Unit of the points at the scale bar; may be empty.
  int width = 1600;                    ///< Maximum width in pixels.
  int height = 1000;                   ///< Maximum height in pixels.
  ViewFrom from = ViewFrom::iso;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Direction against gravity, of any length except 0.
};

/// Returns the picture as the content of a PNG file. Points of a cluster have its colour; other points are
/// grey. The same input gives the same bytes.
///
/// Outliers do not shrink the scene. The frame covers the central 98 % of the points (only points in clusters
/// if there are labels) and the volumes. Of 16 volumes and more, up to a sixteenth at each side is ignored.
/// Without labels, volumes are framed without the points. A picture without content shows only the
/// background.
///
/// Pictures of at least 480 x 320 pixels have the axes (x red, y green, z blue) and a scale bar in the lower
/// left corner. If several methods are drawn, the upper left corner has their names, with their colours if
/// each method has its own, else with their dashes (six kinds, repeated). Labels are written in the given
/// order at volumes whose centre is in the picture; a label that would overlap something written before is
/// left out. `front` and `side` pictures are cropped to their content, but not below 480 x 320.
///
/// Throws std::invalid_argument if width or height is outside 16..16384, or if `up` is zero or not finite.
std::string picture_png(const Picture& picture);

/// Returns the picture as the content of an SVG file: the points as one embedded PNG, the volumes as lines
/// and areas that can be scaled and edited.
std::string picture_svg(const Picture& picture);

/// Writes picture_svg() if the name ends in .svg (in any case), else picture_png(), through
/// write_file_atomically(): after an IoError an existing file is unchanged.
void write_picture(const std::filesystem::path& path, const Picture& picture);

}  // namespace pcl_bv
