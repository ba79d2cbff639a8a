// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The view of the coordinates, and fields added or replaced.
#include "pcl_bv/io/raw_cloud.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "files.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv::detail {
namespace {

void expect_view_of(const RawCloud& cloud) {
  const PointView view = cloud.xyz();
  ASSERT_EQ(view.count, cloud.size());
  for (std::size_t i = 0; i < view.count; ++i) {
    const Coordinates p = load_point(view, i);
    const float expected[3] = {float_at(cloud, "x", i), float_at(cloud, "y", i), float_at(cloud, "z", i)};
    if (std::isnan(expected[0])) {
      EXPECT_TRUE(std::isnan(p.x) && std::isnan(p.y) && std::isnan(p.z));
      continue;
    }
    EXPECT_EQ(p.x, expected[0]);
    EXPECT_EQ(p.y, expected[1]);
    EXPECT_EQ(p.z, expected[2]);
  }
}

using RawCloudFile = FileTest;

TEST_F(RawCloudFile, XyzGivesTheCoordinatesOfEveryLayout) {
  for (const Layout& layout : sample_layouts()) {
    SCOPED_TRACE(layout.name);
    write_pcd(file("a.pcd"), sample_cloud(layout, 20, 2, 5));
    const RawCloud cloud = read_pcd(file("a.pcd"));
    expect_view_of(cloud);
    const std::byte* end = cloud.data.data() + cloud.data.size();
    if (cloud.packed_xyz.empty()) {
      EXPECT_LE(cloud.xyz().address(cloud.size() - 1) + cloud.xyz().readable, end);
    }
  }
}

TEST(ViewOfFields, FindsTheCoordinatesInAMessagesRecords) {
  std::vector<std::byte> data(3 * 40 + 1);
  const std::vector<PointField> fields = {{"ring", 'U', 2, 1, 0},
                                          {"z", 'F', 8, 1, 26},
                                          {"x", 'F', 8, 1, 10},
                                          {"y", 'F', 8, 1, 18},
                                          {"t", 'U', 4, 1, 34}};
  for (std::size_t i = 0; i < 9; ++i) {  // at an odd address
    const double value = 0.1 * static_cast<double>(i);
    std::memcpy(data.data() + 1 + i / 3 * 40 + 10 + i % 3 * 8, &value, 8);
  }
  const PointView view = view_of_fields(data.data() + 1, 3, 40, fields);
  ASSERT_EQ(view.count, 3u);
  EXPECT_EQ(view.scalar, ScalarType::float64);
  EXPECT_EQ(view.readable, 30u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(load_point(view, i).x, 0.1 * static_cast<double>(3 * i));
    EXPECT_EQ(load_point(view, i).z, 0.1 * static_cast<double>(3 * i + 2));
  }
  EXPECT_EQ(view_of_fields(nullptr, 0, 40, fields).count, 0u);
}

TEST(ViewOfFields, RefusesWhatAViewCannotBe) {
  const std::vector<std::byte> data(64);
  const PointField x{"x", 'F', 4, 1, 0}, y{"y", 'F', 4, 1, 4}, z{"z", 'F', 4, 1, 8};
  const auto refused = [&](const std::vector<PointField>& fields, std::size_t step = 16) {
    EXPECT_THROW(view_of_fields(data.data(), 1, step, fields), std::invalid_argument);
  };
  EXPECT_EQ(view_of_fields(data.data(), 5, 12, {x, y, z}).count, 5u);
  refused({x, y});
  refused({x, y, z, x});
  refused({x, y, z}, 11);
  refused({x, y, z}, 0);
  refused({x, y, {"z", 'F', 4, 1, 12}});
  refused({x, y, {"z", 'F', 8, 1, 8}});
  refused({x, y, {"z", 'I', 4, 1, 8}});
  refused({x, y, {"z", 'F', 4, 2, 8}});
  refused({x, y, {"z", 'F', 4, 1, SIZE_MAX}});
  EXPECT_THROW(view_of_fields(nullptr, 1, 16, {x, y, z}), std::invalid_argument);
}

TEST_F(RawCloudFile, XyzViewsTheRecordWhereItCan) {
  write_pcd(file("a.pcd"),
            sample_cloud({"", {{"ring", 'U', 2}, {"x"}, {"y"}, {"z"}, {"i", 'U', 1}}}, 3, 1, 5));
  const RawCloud cloud = read_pcd(file("a.pcd"));
  EXPECT_TRUE(cloud.packed_xyz.empty());
  EXPECT_EQ(cloud.xyz().data, cloud.data.data() + 2);
  EXPECT_EQ(cloud.xyz().stride, 15u);
  EXPECT_EQ(cloud.xyz().readable, 13u);
}

TEST_F(RawCloudFile, XyzPacksWhereTheRecordDoesNotFit) {
  write_pcd(file("a.pcd"), sample_cloud({"", {{"y"}, {"x"}, {"z"}}}, 3, 1, 5));
  const RawCloud cloud = read_pcd(file("a.pcd"));
  EXPECT_EQ(cloud.packed_xyz.size(), 36u);
  EXPECT_EQ(cloud.xyz().stride, 12u);
}

TEST_F(RawCloudFile, DoublesAreViewedAsDoublesToTheBit) {
  const Layout side_by_side{"", {{"t", 'U', 2}, {"x", 'F', 8}, {"y", 'F', 8}, {"z", 'F', 8}, {"i"}}};
  const Layout apart{"", {{"z", 'F', 8}, {"i"}, {"x", 'F', 8}, {"y", 'F', 8}}};
  for (const Layout& layout : {side_by_side, apart}) {
    write_pcd(file("a.pcd"), sample_cloud(layout, 20, 2, 5));
    const RawCloud cloud = read_pcd(file("a.pcd"));
    EXPECT_EQ(cloud.packed_xyz.empty(), layout.fields[0].name == "t");
    const PointView view = cloud.xyz();
    ASSERT_EQ(view.scalar, ScalarType::float64);
    ASSERT_EQ(view.count, 40u);
    for (std::size_t i = 0; i < view.count; ++i) {
      double xyz[3];
      load_point(view, i, xyz);
      const char* names[3] = {"x", "y", "z"};
      for (int axis = 0; axis < 3; ++axis) {
        const std::byte* stored = &cloud.data[i * cloud.point_step + find_field(cloud, names[axis])->offset];
        EXPECT_EQ(std::memcmp(&xyz[axis], stored, 8), 0);
      }
    }
  }
}

TEST(RawCloud, XyzIsEmptyWithoutCoordinates) {
  RawCloud cloud = make_cloud({1, 2, 3});
  cloud.fields[2].name = "w";
  EXPECT_TRUE(cloud.xyz().empty());
  cloud = make_cloud({1, 2, 3});
  cloud.fields[2].type = 'I';
  EXPECT_TRUE(cloud.xyz().empty());
}

TEST(RawCloud, FindFieldGivesTheFirstOfThatName) {
  const RawCloud cloud = make_cloud({});
  EXPECT_EQ(find_field(cloud, "y"), &cloud.fields[1]);
  EXPECT_EQ(find_field(cloud, "label"), nullptr);
}

TEST(MakeCloud, HoldsTheCoordinatesAsGiven) {
  const RawCloud cloud = make_cloud({1, 2, 3, 4, 5, 6});
  EXPECT_EQ(cloud.width, 2u);
  EXPECT_EQ(cloud.height, 1u);
  EXPECT_EQ(load_point(cloud.xyz(), 1).z, 6.0);
  expect_view_of(cloud);
}

TEST(MakeCloud, RefusesHalfAPoint) {
  EXPECT_THROW(make_cloud({1, 2, 3, 4}), std::invalid_argument);
}

std::vector<std::uint32_t> labels_for(const RawCloud& cloud) {
  std::vector<std::uint32_t> labels;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    labels.push_back(4294967295u - static_cast<std::uint32_t>(i));
  return labels;
}

std::uint32_t label_at(const RawCloud& cloud, std::size_t point) {
  std::uint32_t value;
  std::memcpy(&value, &cloud.data.at(point * cloud.point_step + find_field(cloud, "label")->offset), 4);
  return value;
}

// The cloud without its field "label", for comparing the rest.
RawCloud without_label(const RawCloud& cloud) {
  RawCloud rest = cloud;
  rest.fields.clear();
  rest.data.clear();
  rest.point_step = 0;
  for (const PointField& field : cloud.fields) {
    if (field.name == "label") continue;
    rest.fields.push_back(field);
    rest.fields.back().offset = rest.point_step;
    rest.point_step += field.bytes();
  }
  for (std::size_t point = 0; point < cloud.size(); ++point) {
    for (const PointField& field : cloud.fields) {
      const auto from =
          cloud.data.begin() + static_cast<std::ptrdiff_t>(point * cloud.point_step + field.offset);
      if (field.name != "label") {
        rest.data.insert(rest.data.end(), from, from + static_cast<std::ptrdiff_t>(field.bytes()));
      }
    }
  }
  return rest;
}

TEST(SetUint32Field, AddsAFieldAtTheEndAndKeepsTheRest) {
  for (const Layout& layout : sample_layouts()) {
    SCOPED_TRACE(layout.name);
    const RawCloud before = without_label(sample_cloud(layout, 9, 3, 11));
    RawCloud cloud = before;
    set_uint32_field(cloud, "label", labels_for(cloud));
    EXPECT_EQ(cloud.fields.back().name, "label");
    EXPECT_EQ(cloud.point_step, before.point_step + 4);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      EXPECT_EQ(label_at(cloud, i), labels_for(cloud)[i]);
    expect_same_cloud(without_label(cloud), before);
    expect_view_of(cloud);
  }
}

TEST(SetUint32Field, ReplacesAFieldInItsPlaceWhateverItsType) {
  for (const PointField& old : {PointField{"label", 'U', 4}, PointField{"label", 'I', 1},
                                PointField{"label", 'F', 8}, PointField{"label", 'U', 2, 3}}) {
    SCOPED_TRACE(std::string(1, old.type) + std::to_string(old.size) + " x " + std::to_string(old.count));
    const RawCloud before = sample_cloud({"", {{"x"}, {"y"}, old, {"z"}, {"ring", 'U', 2}}}, 8, 2, 13);
    RawCloud cloud = before;
    set_uint32_field(cloud, "label", labels_for(cloud));
    EXPECT_EQ(cloud.fields.size(), before.fields.size());
    EXPECT_EQ(cloud.fields[2].name, "label");
    EXPECT_EQ(cloud.fields[2].type, 'U');
    EXPECT_EQ(cloud.fields[2].bytes(), 4u);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      EXPECT_EQ(label_at(cloud, i), labels_for(cloud)[i]);
    expect_same_cloud(without_label(cloud), without_label(before));
    expect_view_of(cloud);
  }
}

TEST(SetUint32Field, LeavesOneFieldWhereThereWereTwo) {
  RawCloud cloud = sample_cloud({"", {{"label", 'U', 2}, {"x"}, {"y"}, {"z"}, {"label", 'U', 4}}}, 4, 1, 17);
  set_uint32_field(cloud, "label", labels_for(cloud));
  EXPECT_EQ(cloud.fields.size(), 4u);
  EXPECT_EQ(cloud.point_step, 16u);
  EXPECT_EQ(label_at(cloud, 3), labels_for(cloud)[3]);
  expect_view_of(cloud);
}

TEST(SetUint32Field, WorksOnAnEmptyCloud) {
  RawCloud cloud = make_cloud({});
  set_uint32_field(cloud, "label", {});
  EXPECT_EQ(cloud.fields.size(), 4u);
  EXPECT_EQ(cloud.point_step, 16u);
}

TEST(SetUint32Field, RefusesTheWrongNumberOfValues) {
  RawCloud cloud = make_cloud({1, 2, 3});
  EXPECT_THROW(set_uint32_field(cloud, "label", {}), std::invalid_argument);
  EXPECT_THROW(set_uint32_field(cloud, "label", {1, 2}), std::invalid_argument);
  EXPECT_EQ(cloud.fields.size(), 3u);
}

TEST(SetUint32Field, RefusesNamesThatWouldBreakTheCloud) {
  RawCloud cloud = make_cloud({1, 2, 3});
  for (const char* name : {"", "_", "x", "y", "z", "two words", "line\nbreak"}) {
    SCOPED_TRACE(name);
    EXPECT_THROW(set_uint32_field(cloud, name, {1}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
