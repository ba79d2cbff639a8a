// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "volume_bytes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <stdexcept>
#include <type_traits>

namespace pcl_bv::detail {
namespace {

enum class Shape { sphere, empty_sphere, obb, empty_obb };

struct Fixed {
  EstimationStatus status;
  int rank;
  std::size_t used, dropped;
  Shape shape;
  std::array<double, 15> numbers;
};
static_assert(std::is_trivially_copyable_v<Fixed>);

// Returns a view of a copy that is never freed, because EstimationResult::reason does not own its text.
std::string_view interned(const std::string& reason) {
  static std::set<std::string> reasons;
  return reason.empty() ? std::string_view() : *reasons.insert(reason).first;
}

}  // namespace

std::string bytes_of(const Fitted<AnyVolume>& fitted) {
  Fixed fixed;
  std::memset(&fixed, 0, sizeof fixed);
  fixed.status = fitted.status;
  fixed.rank = fitted.rank;
  fixed.used = fitted.used;
  fixed.dropped = fitted.dropped;
  double* to = fixed.numbers.data();
  const auto add = [&](const auto& numbers) { to = std::copy_n(numbers.data(), numbers.size(), to); };
  const bool nothing = empty(fitted.volume);
  if (const auto* sphere = std::get_if<Sphere>(&fitted.volume)) {
    fixed.shape = nothing ? Shape::empty_sphere : Shape::sphere;
    if (!nothing) add(Eigen::Vector3d(sphere->center()));
    if (!nothing) *to = sphere->radius();
  } else if (const auto* obb = std::get_if<Obb>(&fitted.volume)) {
    fixed.shape = nothing ? Shape::empty_obb : Shape::obb;
    if (!nothing) {
      add(Eigen::Vector3d(obb->center()));
      add(Eigen::Matrix3d(obb->axes()));
      add(Eigen::Vector3d(obb->half_extents()));
    }
  } else {
    throw std::invalid_argument("bytes_of: neither a sphere nor a box");
  }
  return std::string(reinterpret_cast<const char*>(&fixed), sizeof fixed).append(fitted.reason);
}

Fitted<AnyVolume> fitted_from(const std::string& bytes) {
  Fixed fixed;
  if (bytes.size() < sizeof fixed) throw std::invalid_argument("fitted_from: ends early");
  std::memcpy(&fixed, bytes.data(), sizeof fixed);
  const double* const numbers = fixed.numbers.data();
  const Eigen::Map<const Eigen::Vector3d> center(numbers), half(numbers + 12);
  Fitted<AnyVolume> fitted;
  static_cast<EstimationResult&>(fitted) = {fixed.status, fixed.rank, fixed.used, fixed.dropped,
                                            interned(bytes.substr(sizeof fixed))};
  switch (fixed.shape) {
    case Shape::sphere:
      fitted.volume = Sphere(center, numbers[3]);
      break;
    case Shape::empty_sphere:
      fitted.volume = Sphere();
      break;
    case Shape::obb:
      fitted.volume = Obb(center, Eigen::Map<const Eigen::Matrix3d>(numbers + 3), half);
      break;
    case Shape::empty_obb:
      fitted.volume = Obb();
  }
  return fitted;
}

}  // namespace pcl_bv::detail
