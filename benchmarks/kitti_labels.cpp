// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "kitti_labels.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace pcl_bv::bench {
namespace {

// KITTI's images have 1224 to 1242 x 370 to 376 pixels.
constexpr double kImageWidth = 1242, kImageHeight = 375;

[[noreturn]] void fail(const std::filesystem::path& file, std::size_t line, const std::string& reason) {
  throw std::runtime_error(file.string() + ": " + (line > 0 ? "line " + std::to_string(line) + ": " : "") +
                           reason);
}

std::vector<std::string> words_of(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
    words.push_back(word);
  return words;
}

double number_of(const std::string& word) {
  std::size_t used = 0;
  double number = 0;
  try {
    number = std::stod(word, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used != word.size() || !std::isfinite(number))
    throw std::runtime_error("'" + word + "' is not a number");
  return number;
}

std::size_t frame_of(const std::string& word) {
  const double number = number_of(word);
  if (number < 0 || number > 1e6 || number != std::floor(number))
    throw std::runtime_error("'" + word + "' is not a frame number");
  return static_cast<std::size_t>(number);
}

// The numbers h w l x y z ry of a label or a detection. (x, y, z) is the centre of the lower face in the
// frame of the camera, in which y points down. ry is the rotation about y; at 0 the length is along x.
struct CameraBox {
  double height, width, length;
  Eigen::Vector3d bottom;
  double yaw;
};

CameraBox camera_box(const std::vector<std::string>& words, std::size_t first) {
  std::vector<double> n;
  for (std::size_t i = first; i < first + 7; ++i)
    n.push_back(number_of(words[i]));
  return {n[0], n[1], n[2], {n[3], n[4], n[5]}, n[6]};
}

template <typename Box>
void place(const CameraBox& from, const KittiCalibration& calibration, Box& to) {
  const Eigen::Vector3d bottom = calibration.to_lidar(from.bottom);
  const Eigen::Vector3d front =
      calibration.to_lidar(from.bottom + Eigen::Vector3d(std::cos(from.yaw), 0, -std::sin(from.yaw)));
  const Eigen::Vector2d along = (front - bottom).head<2>();
  to.base = {bottom.head<2>(), std::atan2(along.y(), along.x()), from.length, from.width};
  to.low = bottom.z();
  to.high = bottom.z() + from.height;
}

// Calls read(words) for each line that is not empty, and adds the file and the line to errors.
void for_each_line(const std::filesystem::path& file,
                   const std::function<void(const std::vector<std::string>&)>& read) {
  std::ifstream lines(file);
  if (!lines) fail(file, 0, "cannot be read");
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    try {
      read(words);
    } catch (const std::exception& error) {
      fail(file, number, error.what());
    }
  }
}

}  // namespace

KittiCalibration::KittiCalibration(const std::filesystem::path& file) {
  std::map<std::string, std::vector<double>> rows;
  for_each_line(file, [&](std::vector<std::string> words) {
    if (words[0].back() == ':') words[0].pop_back();
    for (const auto& [other, name] : {std::pair("R0_rect", "R_rect"), {"Tr_velo_to_cam", "Tr_velo_cam"}})
      if (words[0] == other) words[0] = name;
    if (words[0] != "P2" && words[0] != "R_rect" && words[0] != "Tr_velo_cam") return;
    for (std::size_t i = 1; i < words.size(); ++i)
      rows[words[0]].push_back(number_of(words[i]));
  });
  const auto matrix = [&](const char* name, Eigen::Index columns) {
    if (rows[name].size() != static_cast<std::size_t>(3 * columns))
      fail(file, 0, std::string(name) + " does not have " + std::to_string(3 * columns) + " numbers");
    return Eigen::MatrixXd(
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            rows[name].data(), 3, columns));
  };
  projection_ = matrix("P2", 4);
  Eigen::Matrix4d rectified = Eigen::Matrix4d::Identity(), camera = Eigen::Matrix4d::Identity();
  rectified.topLeftCorner<3, 3>() = matrix("R_rect", 3);
  camera.topRows<3>() = matrix("Tr_velo_cam", 4);
  camera_from_lidar_ = rectified * camera;
  if (std::abs(camera_from_lidar_.determinant()) < 0.5)
    fail(file, 0, "Tr_velo_cam and R_rect are no rotations");
  lidar_from_camera_ = camera_from_lidar_.inverse();
}

Eigen::Vector3d KittiCalibration::to_lidar(const Eigen::Vector3d& camera) const {
  return (lidar_from_camera_ * camera.homogeneous()).head<3>();
}

std::optional<Eigen::Vector2d> KittiCalibration::pixel(const Eigen::Vector3d& lidar) const {
  const Eigen::Vector3d p = projection_ * (camera_from_lidar_ * lidar.homogeneous());
  if (p.z() < 0.1) return std::nullopt;  // behind the camera, or so near that the pixel is far outside
  return Eigen::Vector2d(p.head<2>() / p.z());
}

std::optional<ImageBox> KittiCalibration::project(const FoundBox& box) const {
  const Eigen::Vector2d& at = box.base.center;
  const auto center = pixel({at.x(), at.y(), (box.low + box.high) / 2});
  if (!center ||
      !(center->x() >= 0 && center->x() < kImageWidth && center->y() >= 0 && center->y() < kImageHeight))
    return std::nullopt;
  const Eigen::Vector2d along(std::cos(box.base.yaw), std::sin(box.base.yaw)), left(-along.y(), along.x());
  ImageBox image{center->x(), center->y(), center->x(), center->y()};
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector2d p = at + along * ((corner & 1) != 0 ? 0.5 : -0.5) * box.base.length +
                              left * ((corner & 2) != 0 ? 0.5 : -0.5) * box.base.width;
    const auto found = pixel({p.x(), p.y(), (corner & 4) != 0 ? box.high : box.low});
    if (!found) continue;
    image = {std::min(image.left, found->x()), std::min(image.top, found->y()),
             std::max(image.right, found->x()), std::max(image.bottom, found->y())};
  }
  return ImageBox{std::max(image.left, 0.0), std::max(image.top, 0.0), std::min(image.right, kImageWidth),
                  std::min(image.bottom, kImageHeight)};
}

std::vector<KittiObject> read_kitti_labels(const std::filesystem::path& file,
                                           const KittiCalibration& calibration) {
  std::vector<KittiObject> objects;
  for_each_line(file, [&](const std::vector<std::string>& words) {
    if (words.size() < 17)
      throw std::runtime_error("has " + std::to_string(words.size()) + " columns, not 17");
    KittiObject object;
    object.frame = frame_of(words[0]);
    object.type = words[2];
    object.truncated = static_cast<int>(number_of(words[3]));
    object.occluded = static_cast<int>(number_of(words[4]));
    object.image = {number_of(words[6]), number_of(words[7]), number_of(words[8]), number_of(words[9])};
    if (!object.dont_care()) {
      object.id = static_cast<std::uint32_t>(frame_of(words[1]));
      place(camera_box(words, 10), calibration, object);
    }
    objects.push_back(object);
  });
  return objects;
}

std::vector<KittiDetection> read_kitti_detections(const std::filesystem::path& file,
                                                  const KittiCalibration& calibration) {
  static const std::map<std::string, std::string> types{{"1", "Pedestrian"}, {"2", "Car"}, {"3", "Cyclist"}};
  std::vector<KittiDetection> detections;
  for_each_line(file, [&](const std::vector<std::string>& words) {
    if (words.size() != 15)
      throw std::runtime_error("has " + std::to_string(words.size()) + " columns, not 15");
    const auto type = types.find(words[1]);
    if (type == types.end())
      throw std::runtime_error("'" + words[1] + "' is not one of the types 1, 2 and 3");
    KittiDetection detection;
    detection.frame = frame_of(words[0]);
    detection.type = type->second;
    detection.score = number_of(words[6]);
    place(camera_box(words, 7), calibration, detection);
    detections.push_back(detection);
  });
  return detections;
}

}  // namespace pcl_bv::bench
