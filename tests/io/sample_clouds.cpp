// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// See sample_clouds.h.
#include "sample_clouds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace pcl_bv {
using namespace detail;
namespace {

template <typename T>
bool same_number(const std::byte* a, const std::byte* b) {
  T u, v;
  std::memcpy(&u, a, sizeof u);
  std::memcpy(&v, b, sizeof v);
  return std::memcmp(a, b, sizeof u) == 0 || (std::isnan(u) && std::isnan(v));
}

bool same_element(const PointField& field, const std::byte* a, const std::byte* b) {
  if (field.type == 'F' && field.size == 4) return same_number<float>(a, b);
  if (field.type == 'F' && field.size == 8) return same_number<double>(a, b);
  return std::memcmp(a, b, field.size) == 0;
}

std::vector<PointField> kept_fields(const RawCloud& cloud, bool padding) {
  std::vector<PointField> kept;
  for (const PointField& field : cloud.fields) {
    if (padding || field.name != "_") kept.push_back(field);
  }
  return kept;
}

void fill_element(const PointField& field, std::byte* to, bool nan, std::mt19937& random) {
  const double value = std::uniform_real_distribution<double>(-1000, 1000)(random);
  if (field.name == "_") {
    std::memset(to, 0, field.size);
  } else if (field.type == 'F' && field.size == 4) {
    const float stored = nan ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(value);
    std::memcpy(to, &stored, sizeof stored);
  } else if (field.type == 'F') {
    const double stored = nan ? std::numeric_limits<double>::quiet_NaN() : value;
    std::memcpy(to, &stored, sizeof stored);
  } else {
    for (std::uint32_t i = 0; i < field.size; ++i)
      to[i] = static_cast<std::byte>(random());
  }
}

}  // namespace

const std::vector<Layout>& sample_layouts() {
  static const std::vector<Layout> layouts = {
      {"xyz", {{"x"}, {"y"}, {"z"}}},
      {"xyz_intensity", {{"x"}, {"y"}, {"z"}, {"intensity"}}},
      {"x_at_an_offset", {{"ring", 'U', 2}, {"time", 'F', 8}, {"x"}, {"y"}, {"z"}}},
      {"y_x_z", {{"y"}, {"x"}, {"z"}, {"label", 'U', 4}}},
      {"apart", {{"x"}, {"a", 'U', 1}, {"y"}, {"b", 'I', 2}, {"z"}}},
      {"padded", {{"x"}, {"y"}, {"z"}, {"_", 'U', 1, 4}, {"rgb"}, {"_", 'U', 1, 12}}},
      {"padding_between", {{"x"}, {"_", 'U', 1, 3}, {"y"}, {"_", 'U', 2, 2}, {"z"}}},
      {"counts", {{"x"}, {"y"}, {"z"}, {"fpfh", 'F', 4, 33}, {"bits", 'U', 1, 5}}},
      {"every_type",
       {{"i1", 'I', 1},
        {"u1", 'U', 1},
        {"i2", 'I', 2},
        {"u2", 'U', 2},
        {"i4", 'I', 4},
        {"u4", 'U', 4},
        {"i8", 'I', 8, 2},
        {"u8", 'U', 8},
        {"f8", 'F', 8, 3},
        {"x"},
        {"y"},
        {"z"}}}};
  return layouts;
}

RawCloud sample_cloud(const Layout& layout, std::size_t width, std::size_t height, std::uint32_t seed) {
  RawCloud cloud;
  cloud.fields = layout.fields;
  for (PointField& field : cloud.fields) {
    field.offset = cloud.point_step;
    cloud.point_step += field.bytes();
  }
  cloud.width = width;
  cloud.height = height;
  cloud.viewpoint = {1.5, -2.25, 1e-3, 0.5, -0.5, 0.5, 0.1};
  cloud.data.resize(cloud.size() * cloud.point_step);
  std::mt19937 random(seed);
  std::byte* at = cloud.data.data();
  for (std::size_t point = 0; point < cloud.size(); ++point) {
    for (const PointField& field : cloud.fields) {
      for (std::uint32_t i = 0; i < field.count; ++i, at += field.size) {
        fill_element(field, at, point % 7 == 6, random);
      }
    }
  }
  return cloud;
}

float float_at(const RawCloud& cloud, const std::string& field, std::size_t point) {
  float value;
  std::memcpy(&value, &cloud.data.at(point * cloud.point_step + find_field(cloud, field)->offset),
              sizeof value);
  return value;
}

void expect_same_cloud(const RawCloud& actual, const RawCloud& expected, bool padding) {
  ASSERT_EQ(actual.width, expected.width);
  ASSERT_EQ(actual.height, expected.height);
  EXPECT_EQ(actual.viewpoint, expected.viewpoint);
  ASSERT_EQ(actual.data.size(), actual.size() * actual.point_step);
  const std::vector<PointField> a = kept_fields(actual, padding);
  const std::vector<PointField> b = kept_fields(expected, padding);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t f = 0; f < a.size(); ++f) {
    SCOPED_TRACE("field " + b[f].name);
    ASSERT_EQ(a[f].name, b[f].name);
    ASSERT_EQ(a[f].type, b[f].type);
    ASSERT_EQ(a[f].size, b[f].size);
    ASSERT_EQ(a[f].count, b[f].count);
    for (std::size_t point = 0; point < expected.size(); ++point) {
      for (std::uint32_t i = 0; i < b[f].count; ++i) {
        ASSERT_TRUE(same_element(b[f], &actual.data[point * actual.point_step + a[f].offset + i * a[f].size],
                                 &expected.data[point * expected.point_step + b[f].offset + i * b[f].size]))
            << "point " << point << ", element " << i;
      }
    }
  }
}

}  // namespace pcl_bv
