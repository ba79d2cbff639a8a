// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Labels, detections and calibrations of KITTI's tracking benchmark (Geiger et al. 2012), converted to the
// frame of the LiDAR.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "result_lines.h"

namespace pcl_bv::bench {

/// A rectangle in the image of the left colour camera, pixels.
struct ImageBox {
  double left = 0, top = 0, right = 0, bottom = 0;

  double area() const { return (right - left) * (bottom - top); }
};

/// A line of a label file. DontCare has no box, only a rectangle in the image.
struct KittiObject {
  std::size_t frame = 0;
  std::uint32_t id = 0;
  std::string type;
  int truncated = 0, occluded = 0;
  ImageBox image;
  GroundBox base;  ///< In the frame of the LiDAR, metres.
  double low = 0, high = 0;

  bool dont_care() const { return type == "DontCare"; }
};

/// A line of a detection file, in the frame of the LiDAR.
struct KittiDetection {
  std::size_t frame = 0;
  std::string type;
  double score = 0;
  GroundBox base;
  double low = 0, high = 0;
};

class KittiCalibration {
 public:
  /// Reads the lines P2, R_rect (or R0_rect) and Tr_velo_cam (or Tr_velo_to_cam) of a calibration file.
  /// Throws std::runtime_error with the file and the reason.
  explicit KittiCalibration(const std::filesystem::path& file);

  /// Returns a point of the rectified camera frame in the frame of the LiDAR.
  Eigen::Vector3d to_lidar(const Eigen::Vector3d& camera) const;

  /// Returns the rectangle of a box in the image. Returns nullopt if the centre of the box is not in the
  /// image.
  std::optional<ImageBox> project(const FoundBox& box) const;

 private:
  std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& lidar) const;

  Eigen::Matrix<double, 3, 4> projection_;  // from the rectified camera frame
  Eigen::Matrix4d camera_from_lidar_, lidar_from_camera_;
};

/// Reads a file of label_02: frame id type truncated occluded alpha left top right bottom h w l x y z ry.
/// Throws std::runtime_error with the file, the line and the reason.
std::vector<KittiObject> read_kitti_labels(const std::filesystem::path& file,
                                           const KittiCalibration& calibration);

/// Reads a file of detections as AB3DMOT uses it: frame, type, left, top, right, bottom, score, h, w, l, x,
/// y, z, ry, alpha, with commas. The types are 1 Pedestrian, 2 Car and 3 Cyclist. Throws as
/// read_kitti_labels() does.
std::vector<KittiDetection> read_kitti_detections(const std::filesystem::path& file,
                                                  const KittiCalibration& calibration);

}  // namespace pcl_bv::bench
