// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds of many record layouts with known bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
using namespace detail;

struct Layout {
  std::string name;
  std::vector<PointField> fields;  ///< Offsets are set by sample_cloud().
};

/// x first, x at an offset, y x z order, interleaved padding, counts > 1, elements of 1, 2, 4 and 8 bytes.
const std::vector<Layout>& sample_layouts();

/// A cloud of that layout. Every element is a random value of its type; floating-point elements are finite,
/// and every seventh point is NaN in all of them. Padding is zero.
RawCloud sample_cloud(const Layout& layout, std::size_t width, std::size_t height, std::uint32_t seed);

/// The value of a float32 field as stored.
float float_at(const RawCloud& cloud, const std::string& field, std::size_t point);

/// All of the two clouds is the same, except that NaNs of other bits are equal. `padding`: whether "_"
/// counts.
void expect_same_cloud(const RawCloud& actual, const RawCloud& expected, bool padding = true);

}  // namespace pcl_bv
