// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads poses in the formats of KITTI and TUM.

#include "sources.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "pcl_bv/io/number_text.h"
#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::detail {
namespace {

// The numbers of a line. long double represents today's times in seconds with an error below a nanosecond.
using Numbers = std::vector<long double>;

// Returns the numbers of a line. Returns none if the line contains anything else.
Numbers numbers_of(std::string_view line) {
  Numbers numbers;
  for (;;) {
    long double value = 0;
    if (!next_number(line, value, " \t\r,")) return line.empty() ? numbers : Numbers();
    if (!std::isfinite(value)) return {};
    numbers.push_back(value);
  }
}

Pose pose_of(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation) {
  Pose pose = Pose::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

// Returns the pose, or nullopt if the first three columns are not a rotation to within 1e-3.
std::optional<Pose> pose_of_rows(const Numbers& rows) {
  Eigen::Matrix<double, 3, 4> m;
  for (std::size_t i = 0; i < 12; ++i)
    m(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = static_cast<double>(rows[i]);
  const Eigen::Matrix3d rotation = m.leftCols<3>();
  if (!(rotation * rotation.transpose()).isIdentity(1e-3) || rotation.determinant() < 0) return std::nullopt;
  return pose_of(Eigen::Quaterniond(rotation), m.col(3));
}

std::optional<Pose> pose_of_tum(const Numbers& n) {
  const auto number = [&](std::size_t i) { return static_cast<double>(n[i]); };
  const Eigen::Quaterniond rotation(number(7), number(4), number(5), number(6));
  if (std::abs(rotation.squaredNorm() - 1) > 1e-2) return std::nullopt;
  return pose_of(rotation, {number(1), number(2), number(3)});
}

std::string text_of(const std::filesystem::path& file) {
  try {
    return read_untrusted_text(file, kMaxPosesBytes);
  } catch (const IoError& error) {
    throw IoError(file.string() + ": " + error.what());
  }
}

// Returns the transform from the sensor to the left camera, whose poses KITTI's files contain. Returns
// nullopt if there is no calib.txt with a line "Tr:".
std::optional<Pose> camera_from_calibration(const std::filesystem::path& poses) {
  const std::filesystem::path file = poses.parent_path() / "calib.txt";
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) return std::nullopt;
  std::istringstream calibration(text_of(file));
  for (std::string line; std::getline(calibration, line);) {
    if (!line.starts_with("Tr:")) continue;
    const Numbers rows = numbers_of(std::string_view(line).substr(3));
    std::optional<Pose> pose = rows.size() == 12 ? pose_of_rows(rows) : std::nullopt;
    if (!pose) throw IoError(file.string() + ": Tr is not a pose (12 numbers: a rotation and a translation)");
    return pose;
  }
  return std::nullopt;
}

}  // namespace

Poses::Poses(const std::filesystem::path& file, std::optional<std::size_t> frames,
             std::vector<std::size_t> frame_numbers) {
  std::istringstream stream(text_of(file));
  std::size_t line_number = 0, columns = 0;
  const auto fail = [&](const std::string& what) {
    const std::string where = line_number > 0 ? ": line " + std::to_string(line_number) : "";
    throw IoError(file.string() + where + ": " + what);
  };
  const std::optional<Pose> camera = camera_from_calibration(file);
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    if (line.starts_with('#') || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const Numbers numbers = numbers_of(line);
    if (columns == 0) columns = numbers.size();
    if (numbers.size() != columns || (columns != 8 && columns != 12))
      fail("must have 12 numbers (KITTI) or 8 (TUM), as many as the lines before");
    by_stamp_ = columns == 8;
    std::optional<Pose> pose = by_stamp_ ? pose_of_tum(numbers) : pose_of_rows(numbers);
    if (!pose) fail("not a rotation");
    if (!by_stamp_ && camera) pose = camera->inverse() * *pose * *camera;
    if (by_stamp_ && std::abs(numbers[0]) > 9e9L) fail("not a time in seconds");
    const std::int64_t stamp = by_stamp_ ? std::llround(1e9L * numbers[0]) : 0;
    if (by_stamp_ && !poses_.empty() && stamp <= poses_.back().first) fail("not later than the line before");
    poses_.emplace_back(stamp, *pose);
  }
  line_number = 0;
  if (poses_.empty()) fail("no poses");
  if (by_stamp_) return;
  if (!frames)
    fail(
        "frames whose number is not known before need poses by time (TUM: 8 numbers per line), not by "
        "frame (KITTI)");
  if (poses_.size() == *frames) return;
  const std::string counts =
      std::to_string(poses_.size()) + " poses of " + std::to_string(*frames) + " frames";
  if (frame_numbers.empty()) fail(counts);
  const auto [first, last] = std::minmax_element(frame_numbers.begin(), frame_numbers.end());
  const std::string range = std::to_string(*first) + " to " + std::to_string(*last);
  if (*last >= poses_.size())
    fail(counts + "; a file name has the number " + std::to_string(*last) + ", but the last pose is number " +
         std::to_string(poses_.size() - 1));
  note_ = file.string() + ": " + counts + ": matched by the numbers in the file names, " + range +
          " (the first pose is number 0)";
  numbers_ = std::move(frame_numbers);
}

std::optional<Pose> Poses::at(std::size_t number, std::int64_t stamp_ns) const {
  if (poses_.empty()) return std::nullopt;
  if (!by_stamp_) {  // no pose if the recording has more clouds than its index tells
    if (!numbers_.empty()) number = numbers_.at(number);
    return number < poses_.size() ? std::optional(poses_[number].second) : std::nullopt;
  }
  return pose_at(poses_, stamp_ns);
}

}  // namespace pcl_bv::detail
