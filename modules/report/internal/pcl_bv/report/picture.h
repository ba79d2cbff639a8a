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
#include "pcl_bv/report/report.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A volume, and the colour and label with which it is drawn.
struct PictureVolume {
  AnyVolume volume;
  std::uint32_t colour = 0;  ///< Number of the colour: id of the cluster or, without clusters, `method`.
  std::string label = {};    ///< Text above the volume, in the same colour. Bytes outside ASCII become '?'.
  std::uint32_t method = 0;  ///< Index of the volume's method in Picture::methods.
};

/// Directions of view. All projections are parallel. If z is up, the horizontal axes are x and y. For another
/// `up`, the first horizontal axis is the projection of x onto the horizontal plane. If x is within 26
/// degrees of the line along `up`, y is projected instead. The second horizontal axis is 90 degrees to the
/// left of the first, seen from above. For example, in a camera's frame (y down) the second horizontal axis
/// is z.
enum class ViewFrom {
  iso,    ///< Looks down at 35 degrees, from the front left.
  top,    ///< Looks down. The first horizontal axis points right, the second up.
  front,  ///< Looks along the second horizontal axis. The first points right, `up` points up.
  side    ///< Looks opposite to the first horizontal axis. The second points right, `up` points up.
};

/// The content of a picture.
struct Picture {
  PointView points;  ///< Points to draw. Non-finite points, and points at exactly 0,0,0, are left out.
  /// Cluster id of every point of the cloud. If null, points are coloured by height.
  const std::uint32_t* labels = nullptr;
  std::vector<PictureVolume> volumes;  ///< Empty volumes are left out.
  std::vector<std::string> methods;    ///< Names for the legend, in ASCII. Other bytes become '?'.
  std::string unit = "m";              ///< Unit of the points, written at the scale bar; may be empty.
  int width = 1600;                    ///< Maximum width in pixels.
  int height = 1000;                   ///< Maximum height in pixels.
  ViewFrom from = ViewFrom::iso;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Direction against gravity, of any length except 0.
};

/// Returns the picture as the content of a PNG file. If there are labels, points of a cluster have the
/// cluster's colour, and all other points are grey. The same input gives the same bytes.
///
/// The frame covers these parts of the scene:
/// - The volumes. If there are 16 or more, the outermost sixteenth is ignored at each side of the frame.
/// - The points, except the outermost 1 % at each side. If there are labels, only points of clusters are
///   used. If there are volumes but no labels, no points are used.
///
/// Outliers are ignored because they would make all other points and volumes small.
///
/// A picture without points and volumes shows only the background.
///
/// Pictures of at least 480 x 320 pixels have the axes (x red, y green, z blue) and a scale bar in the lower
/// left corner. If several methods are drawn, the upper left corner lists their names. A line next to each
/// name has the colour of the method if each method has its own colour. Otherwise the line has the dashes of
/// the method (six kinds, repeated). The label of a volume is written if the volume's centre is in the
/// picture. Labels are written in the order of Picture::volumes. A label that would overlap an earlier text
/// or mark is left out. `front` and `side` pictures are cropped to their content, but not below 480 x 320.
///
/// Throws std::invalid_argument if width or height is outside 16..16384, or if `up` is zero or not finite.
std::string picture_png(const Picture& picture);

/// Returns the picture as the content of an SVG file. The points are one embedded PNG. The volumes are lines
/// and areas that can be scaled and edited.
std::string picture_svg(const Picture& picture);

/// Writes picture_svg() if the name ends in .svg (in any case), else picture_png(). Writes the file through
/// write_file_atomically(). Throws IoError if writing fails. An existing file is then unchanged.
void write_picture(const std::filesystem::path& path, const Picture& picture);

}  // namespace detail
}  // namespace pcl_bv
