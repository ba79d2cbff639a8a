// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Asks many questions about the points of a DeviceTree.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "device_tree.h"
#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::detail {

/// What questions ask for, as questions.comp numbers it.
enum class QuestionKind : std::uint32_t { any, nearest, first_hit };

/// A question as the shader reads it, which explains the members. With limit < 0 it has no candidate.
struct DeviceQuestion {
  float place[3] = {}, limit = -1;
  float direction[3] = {}, error = 0;
  float inside = -1, reach = 0;
  float unused[2] = {};
};

/// A point that can be the answer.
struct Candidate {
  float x, y, z;
  std::uint32_t number;  ///< Of the point in its part.
};

/// An answer of one part of the tree as the shader writes it.
struct DeviceAnswer {
  static constexpr std::uint32_t kMany = 0xfffffffe, kCertainly = 0xffffffff;

  std::uint32_t candidates, unused[3];
  Candidate found[4];
};

/// Distances and coordinates above this are not for the device.
inline constexpr double kLargestOnDevice = 0x1p54;

/// Makes the question of a point or a sphere's origin. Returns nothing if the coordinates of the point, of
/// the tree or `reach` are too large for the device. The errors of distances on the device are below
/// DeviceQuestion::error.
std::optional<DeviceQuestion> question_at(const DeviceTree& tree, const Coordinates& place, double reach);

/// Asks questions number 0 to count - 1. make(i) returns question i; it may be called by several threads.
/// Calls take(i, part, answer) for each question and each part of the tree, for one question by one thread at
/// a time, part after part.
void ask(const DeviceTree& tree, QuestionKind kind, std::size_t count, const Execution& execution,
         const std::function<DeviceQuestion(std::size_t)>& make,
         const std::function<void(std::size_t, const TreePart&, const DeviceAnswer&)>& take);

}  // namespace pcl_bv::detail
