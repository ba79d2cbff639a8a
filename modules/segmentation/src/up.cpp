// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/up.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "up_frame.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr std::string_view axis_names = "xyz";

bool is_direction(const Vector3d& up) {
  return up.allFinite() && !up.isZero(0);
}

// Reads three numbers between commas. Returns false for other text.
bool read_numbers(std::string_view text, Vector3d& up) {
  const char* at = text.data();
  const char* const end = at + text.size();
  for (Index i = 0; i < 3; ++i) {
    if (i > 0 && (at == end || *at++ != ',')) return false;
    const auto [after, error] = std::from_chars(at, end, up[i]);
    if (error != std::errc()) return false;
    at = after;
  }
  return at == end;
}

}  // namespace

Vector3d parse_up(std::string_view text) {
  const std::string_view name = text.substr(text.substr(0, 1) == "-" ? 1 : 0);
  const std::size_t axis = name.size() == 1 ? axis_names.find(name) : std::string_view::npos;
  Vector3d up = Vector3d::Zero();
  if (axis != std::string_view::npos) {
    up[static_cast<Index>(axis)] = name == text ? 1 : -1;
  } else if (!read_numbers(text, up) || !is_direction(up)) {
    throw std::invalid_argument("up is '" + std::string(text) +
                                "', must be x, y, z, -x, -y, -z or X,Y,Z: three finite numbers, not all 0");
  }
  return up;
}

std::string format_up(const Vector3d& up) {
  std::string text;
  for (Index i = 0; i < 3; ++i) {
    if (up == Vector3d::Unit(i) || up == -Vector3d::Unit(i))
      return (up[i] < 0 ? "-" : "") + std::string(1, axis_names[static_cast<std::size_t>(i)]);
    char digits[32];
    if (i > 0) text += ',';
    text.append(digits, std::to_chars(digits, digits + sizeof digits, up[i]).ptr);
  }
  return text;
}

Vector3d normalized_up(const Vector3d& up) {
  const FloatEnvironment environment;
  if (!is_direction(up)) throw std::invalid_argument("up is " + format_up(up) + ", must be finite and not 0");
  const Vector3d unit = unit3(Vector3d(up / up.cwiseAbs().maxCoeff()));
  return unit.array() + 0.0;  // no -0
}

UpFrame::UpFrame(const Vector3d& any_length) : up(normalized_up(any_length)) {
  up.cwiseAbs().maxCoeff(&nearest);
  Vector3d axis = Vector3d::Zero();
  axis[nearest] = std::copysign(1, up[nearest]);
  along_axis = up == axis;
  const auto rotated = [&](Index i) -> Vector3d {  // the rotation moves the nearest axis to up
    return Vector3d::Unit(i) - up[i] / (1 + std::abs(up[nearest])) * (up + axis);
  };
  u = rotated((nearest + 1) % 3);
  v = rotated((nearest + 2) % 3);
}

}  // namespace pcl_bv::detail
