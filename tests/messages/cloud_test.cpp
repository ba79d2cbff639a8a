// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/messages/cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv::detail {
namespace {

using msg::PointField;

// A cloud whose bytes are its own.
struct Made {
  msg::PointCloud2 cloud;
  std::vector<std::byte> bytes;
};

template <class T>
void put(Made& made, std::size_t offset, T value, bool swap = false) {
  std::byte raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (swap) std::reverse(raw, raw + sizeof(T));
  std::memcpy(made.bytes.data() + offset, raw, sizeof(T));
}

// Points (i, i + 0.5, -i) of float32 in records of 16 bytes, intensity last; rows with `padding` bytes after
// each.
Made cloud_of(std::uint32_t width, std::uint32_t height = 1, std::uint32_t padding = 0) {
  Made made;
  msg::PointCloud2& cloud = made.cloud;
  cloud.width = width;
  cloud.height = height;
  cloud.point_step = 16;
  cloud.row_step = 16 * width + padding;
  cloud.fields = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"intensity", 12, 7, 1}};
  made.bytes.resize(std::size_t{cloud.row_step} * height);
  for (std::uint32_t i = 0; i < width * height; ++i) {
    const std::size_t at = i / width * cloud.row_step + i % width * 16;
    const auto number = static_cast<float>(i);
    put(made, at, number);
    put(made, at + 4, number + 0.5F);
    put(made, at + 8, -number);
    put(made, at + 12, 100 + number);
  }
  cloud.data = {made.bytes.data(), made.bytes.size()};
  return made;
}

void expect_points(const PointView& view, std::size_t count) {
  ASSERT_EQ(view.count, count);
  for (std::size_t i = 0; i < count; ++i) {
    const Coordinates p = load_point(view, i);
    const auto number = static_cast<double>(i);
    EXPECT_EQ(p.x, number);
    EXPECT_EQ(p.y, number + 0.5);
    EXPECT_EQ(p.z, -number);
  }
}

TEST(CloudMessage, IsViewedWhereItLies) {
  const Made made = cloud_of(5, 2);
  const auto view = view_points(made.cloud);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->data, made.bytes.data());
  EXPECT_EQ(view->readable, 16U);
  expect_points(*view, 10);
  const RawCloud raw = raw_cloud_of(made.cloud);
  expect_points(raw.xyz(), 10);
  EXPECT_EQ(raw.height, 2U);
}

TEST(CloudMessage, WithPaddedRowsIsCopied) {
  const Made made = cloud_of(3, 4, 5);
  EXPECT_FALSE(view_points(made.cloud));
  expect_points(raw_cloud_of(made.cloud).xyz(), 12);
}

TEST(CloudMessage, InTheOtherByteOrderIsCopied) {
  Made made = cloud_of(4);
  for (std::size_t at = 0; at < made.bytes.size(); at += 4)
    std::reverse(made.bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 made.bytes.begin() + static_cast<std::ptrdiff_t>(at) + 4);
  made.cloud.is_bigendian = true;
  EXPECT_FALSE(view_points(made.cloud));
  const RawCloud raw = raw_cloud_of(made.cloud);
  expect_points(raw.xyz(), 4);
  float intensity;
  std::memcpy(&intensity, raw.data.data() + 16 + 12, 4);
  EXPECT_EQ(intensity, 101);
}

// x in the type of each number, y float32, z float64: each keeps its value.
template <class T>
void expect_type(std::uint8_t datatype, T value, ScalarType becomes, bool swap) {
  Made made;
  made.bytes.resize(24);
  put(made, 1, value, swap);
  put(made, 9, 2.5F, swap);
  put(made, 16, static_cast<std::int16_t>(-7), swap);
  made.cloud.width = 1;
  made.cloud.point_step = 24;
  made.cloud.is_bigendian = swap;
  made.cloud.fields = {
      {"z", 16, PointField::INT16, 1}, {"x", 1, datatype, 1}, {"y", 9, PointField::FLOAT32, 1}};
  made.cloud.data = {made.bytes.data(), made.bytes.size()};
  EXPECT_FALSE(view_points(made.cloud));
  const RawCloud raw = raw_cloud_of(made.cloud);
  ASSERT_EQ(raw.xyz().count, 1U) << int{datatype};
  EXPECT_EQ(raw.xyz().scalar, becomes) << int{datatype};
  const Coordinates p = load_point(raw.xyz(), 0);
  EXPECT_EQ(p.x, static_cast<double>(value)) << int{datatype};
  EXPECT_EQ(p.y, 2.5);
  EXPECT_EQ(p.z, -7);
}

TEST(CloudMessage, OfAnyDatatypeKeepsItsValues) {
  for (const bool swap : {false, true}) {
    expect_type<std::int8_t>(PointField::INT8, -128, ScalarType::float32, swap);
    expect_type<std::uint8_t>(PointField::UINT8, 255, ScalarType::float32, swap);
    expect_type<std::int16_t>(PointField::INT16, -32768, ScalarType::float32, swap);
    expect_type<std::uint16_t>(PointField::UINT16, 65535, ScalarType::float32, swap);
    expect_type<std::int32_t>(PointField::INT32, -2147483647, ScalarType::float64, swap);
    expect_type<std::uint32_t>(PointField::UINT32, 4294967295U, ScalarType::float64, swap);
    expect_type<float>(PointField::FLOAT32, 0.1F, ScalarType::float32, swap);
    expect_type<double>(PointField::FLOAT64, 0.1, ScalarType::float64, swap);
  }
}

TEST(CloudMessage, OfDoublesIsViewedWhereItLies) {
  Made made;
  made.bytes.resize(2 * 29);
  for (std::size_t i = 0; i < 6; ++i)
    put(made, i / 3 * 29 + 5 + i % 3 * 8, 0.1 * static_cast<double>(i));
  made.cloud.width = 2;
  made.cloud.point_step = 29;
  made.cloud.fields = {{"x", 5, 8, 1}, {"y", 13, 8, 0}, {"z", 21, 8, 1}};
  made.cloud.data = {made.bytes.data(), made.bytes.size()};
  const auto view = view_points(made.cloud);
  ASSERT_TRUE(view);
  EXPECT_EQ(load_point(*view, 1).z, 0.5);
}

std::string error_of(const std::function<void(Made&)>& spoil) {
  Made made = cloud_of(4, 2);
  spoil(made);
  std::string said[2];
  for (const bool copy : {false, true}) {
    try {
      if (copy) {
        raw_cloud_of(made.cloud);
      } else {
        view_points(made.cloud);
      }
    } catch (const MessageError& error) {
      said[copy] = error.what();
    }
  }
  EXPECT_EQ(said[0], said[1]);
  return said[0];
}

TEST(CloudMessage, ThatDoesNotFitItsDataIsRefused) {
  EXPECT_EQ(error_of([](Made& m) { m.cloud.data.size -= 1; }),
            "the cloud should have 4 x 2 points of 16 bytes, but has only 127 bytes");
  EXPECT_EQ(error_of([](Made& m) { m.cloud.width = m.cloud.height = m.cloud.row_step = 0xFFFFFFFF; }),
            "the cloud should have 4294967295 x 4294967295 points of 16 bytes, but has only 128 bytes");
  EXPECT_EQ(error_of([](Made& m) { m.cloud.point_step = 0; }), "the cloud has 4 x 2 points of 0 bytes");
  EXPECT_EQ(error_of([](Made& m) {
              m.cloud.row_step = 63;
              m.bytes.resize(130);
              m.cloud.data = {m.bytes.data(), m.bytes.size()};
            }),
            "the cloud has a row_step of 63 for 4 x 2 points of 16 bytes in 130 bytes; without padding a row "
            "has 64");
  EXPECT_EQ(error_of([](Made& m) { m.cloud.fields.erase(m.cloud.fields.begin() + 1); }),
            "the cloud has no field y, its fields are 'x, z, intensity'");
  EXPECT_EQ(error_of([](Made& m) { m.cloud.fields[2].offset = 13; }),
            "the cloud has a field 'z' that exceeds the point_step of 16 bytes");
  EXPECT_EQ(error_of([](Made& m) { m.cloud.fields[0].datatype = 9; }),
            "the cloud has a field 'x' that is of datatype 9, not 1 to 8");
}

TEST(CloudMessage, WithFieldsLongerThanTwoRecordsIsCopiedWithoutTheRest) {
  Made made = cloud_of(4);
  made.cloud.fields.insert(made.cloud.fields.end(), 5, {"a", 0, PointField::UINT8, 16});
  EXPECT_TRUE(view_points(made.cloud));
  const RawCloud raw = raw_cloud_of(made.cloud);
  EXPECT_EQ(raw.point_step, 32U);
  expect_points(raw.xyz(), 4);
  EXPECT_THAT(raw.note, testing::StartsWith("field 'a' is left out: it would make"));
  EXPECT_THAT(raw.note, testing::EndsWith("; and others"));
}

// Drivers write the bytes of all rows, the points of a row, or nothing.
TEST(CloudMessage, WhoseDataAreJustItsPointsHasNoPaddingWhateverItsRowStep) {
  for (const std::uint32_t row_step : {0U, 2U, 63U, 65U, 128U, 0xFFFFFFFFU}) {
    Made made = cloud_of(4, 2);
    made.cloud.row_step = row_step;
    const auto view = view_points(made.cloud);
    ASSERT_TRUE(view) << row_step;
    expect_points(*view, 8);
    const RawCloud raw = raw_cloud_of(made.cloud);
    expect_points(raw.xyz(), 8);
    EXPECT_EQ(raw.height, 2U);
    made.cloud.is_bigendian = true;  // copied
    EXPECT_EQ(raw_cloud_of(made.cloud).size(), 8U);
  }
}

TEST(CloudMessage, OfOneRowIgnoresItsRowStep) {
  for (const std::uint32_t height : {0U, 1U}) {
    Made made = cloud_of(5);
    made.cloud.height = height;
    made.cloud.row_step = 7;
    expect_points(*view_points(made.cloud), 5);
    expect_points(raw_cloud_of(made.cloud).xyz(), 5);
  }
}

// A field that nobody asked for costs nothing but itself, in place and copied, with the same words.
TEST(CloudMessage, WithAFieldThatCannotBeReadIsReadWithoutIt) {
  const auto note_of = [](msg::PointField field) {
    Made made = cloud_of(4, 2);
    made.cloud.fields[3] = std::move(field);
    expect_points(*view_points(made.cloud), 8);
    const RawCloud raw = raw_cloud_of(made.cloud);
    expect_points(raw.xyz(), 8);
    EXPECT_EQ(raw.fields.size(), 3U);
    EXPECT_EQ(raw.note, skipped_fields_note(made.cloud));
    return raw.note;
  };
  EXPECT_EQ(note_of({"new", 12, 9, 1}), "field 'new' is left out: it is of datatype 9, not 1 to 8");
  EXPECT_EQ(note_of({"none", 12, 0, 1}), "field 'none' is left out: it is of datatype 0, not 1 to 8");
  EXPECT_EQ(note_of({"ring", 14, PointField::FLOAT32, 1}),
            "field 'ring' is left out: it exceeds the point_step of 16 bytes");
  EXPECT_EQ(note_of({"far", 0xFFFFFFFF, PointField::UINT8, 0xFFFFFFFF}),
            "field 'far' is left out: it exceeds the point_step of 16 bytes");
  EXPECT_EQ(note_of({"x", 12, PointField::FLOAT32, 1}), "field 'x' is left out: it occurs twice");
  EXPECT_EQ(skipped_fields_note(cloud_of(2).cloud), "");
}

TEST(CloudMessage, OfFewerPointsThanItsDataHasGivesANote) {
  for (Made made : {cloud_of(5), cloud_of(5, 3), cloud_of(5, 3, 40), cloud_of(5, 1, 40)}) {
    EXPECT_EQ(skipped_fields_note(made.cloud), "");
    --made.cloud.width;
    if (made.cloud.height == 1) made.cloud.row_step -= 16;
    if (made.cloud.height == 3) {
      ++made.cloud.width;
      --made.cloud.height;
    }
    EXPECT_EQ(skipped_fields_note(made.cloud),
              "the data has more bytes than the points need; they are not read");
    EXPECT_EQ(raw_cloud_of(made.cloud).note, skipped_fields_note(made.cloud));
  }
}

TEST(CloudMessage, MayCountItsCoordinatesAsItLikes) {
  Made made = cloud_of(4);
  made.cloud.fields[0].count = 4;
  made.cloud.fields[2].count = 0;
  expect_points(*view_points(made.cloud), 4);
  expect_points(raw_cloud_of(made.cloud).xyz(), 4);
}

TEST(CloudMessage, HasItsCoordinatesInUpperCaseWhereThereAreNoOthers) {
  Made made = cloud_of(4);
  made.cloud.fields = {{"X", 0, 7, 1}, {"Y", 4, 7, 1}, {"Z", 8, 7, 1}, {"intensity", 12, 7, 1}};
  expect_points(*view_points(made.cloud), 4);
  const RawCloud raw = raw_cloud_of(made.cloud);
  expect_points(raw.xyz(), 4);
  EXPECT_EQ(raw.fields[1].name, "y");
  made.cloud.fields.push_back({"x", 12, 7, 1});  // that one counts
  EXPECT_FALSE(view_points(made.cloud));
  EXPECT_EQ(load_point(raw_cloud_of(made.cloud).xyz(), 1).x, 101);
}

TEST(CloudMessage, OfNoPointsIsEmpty) {
  Made made = cloud_of(4);
  made.cloud.width = 0;
  made.cloud.data = {};
  ASSERT_TRUE(view_points(made.cloud));
  EXPECT_TRUE(view_points(made.cloud)->empty());
  EXPECT_EQ(raw_cloud_of(made.cloud).size(), 0U);
  EXPECT_EQ(raw_cloud_of(made.cloud).fields.size(), 4U);
}

// What filters publish when nothing is left.
TEST(CloudMessage, OfNoPointsNeedsNoFieldsNorARecord) {
  for (const std::uint32_t height : {0U, 1U}) {
    for (const std::uint32_t step : {0U, 16U}) {
      for (const bool fields : {false, true}) {
        msg::PointCloud2 cloud;
        cloud.height = height;
        cloud.point_step = step;
        if (fields) cloud.fields = {{"x", 0, 7, 1}, {"y", 40, 99, 1}};
        ASSERT_TRUE(view_points(cloud));
        EXPECT_TRUE(view_points(cloud)->empty());
        EXPECT_EQ(skipped_fields_note(cloud), "");
        const RawCloud raw = raw_cloud_of(cloud);
        EXPECT_EQ(raw.size(), 0U);
        EXPECT_TRUE(raw.xyz().empty());
        EXPECT_EQ(raw.fields.size(), 3U);  // as every cloud that is written has
      }
    }
  }
}

TEST(CloudMessage, KeepsItsOtherFields) {
  Made made = cloud_of(3);
  made.cloud.fields[3] = {"two words", 12, PointField::UINT16, 2};
  made.cloud.fields.push_back({"label", 12, PointField::UINT16, 1});
  put(made, 16 + 12, std::uint16_t{500});
  const RawCloud raw = raw_cloud_of(made.cloud);
  EXPECT_EQ(raw.fields[3].name, "_");
  EXPECT_EQ(raw.point_step, 18U);
  EXPECT_EQ(integers_of(raw, "label")[1], 500);
}

TEST(IntensityInPlace, IsTheFieldOfThatNameWhereItLies) {
  Made made = cloud_of(5, 2);
  const auto intensity = view_intensity(made.cloud);
  ASSERT_TRUE(intensity.has_value());
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_EQ(intensity->at(i), 100 + static_cast<float>(i));
  made.cloud.fields[3] = {"reflectivity", 12, 2, 1};  // UINT8
  EXPECT_EQ(view_intensity(made.cloud)->size, 1U);
  EXPECT_EQ(view_intensity(made.cloud)->at(0), 0);  // the last byte of 100.F is not the first
}

TEST(TimesInPlace, AreTheFieldOfThatNameWithFullPrecision) {
  Made made = cloud_of(5, 2);
  EXPECT_FALSE(view_times(made.cloud).has_value());
  for (const char* name : {"t", "time", "timestamp", "time_stamp", "offset_time", "time_ns"}) {
    made.cloud.fields[3] = {name, 12, PointField::UINT32, 1};
    put(made, 12, std::uint32_t{4'000'000'003});
    const auto times = view_times(made.cloud);
    ASSERT_TRUE(times.has_value()) << name;
    EXPECT_EQ(times->number(0), 4'000'000'003.0) << name;
    EXPECT_NE(times->at(0), 4'000'000'003.0) << name;  // a float32 has 24 bits
  }
  made.cloud.fields[3].name = "t0";
  EXPECT_FALSE(view_times(made.cloud).has_value());
}

TEST(IntensityInPlace, IsNoneWhereItCannotBeReadThere) {
  const auto without = [](auto change) {
    Made made = cloud_of(5, 2);
    change(made.cloud);
    return !view_intensity(made.cloud).has_value();
  };
  EXPECT_TRUE(without([](msg::PointCloud2& cloud) { cloud.fields.pop_back(); }));
  EXPECT_TRUE(without([](msg::PointCloud2& cloud) { cloud.fields[3].offset = 13; }));
  EXPECT_TRUE(without([](msg::PointCloud2& cloud) { cloud.fields[3].offset = 0xFFFFFFFF; }));
  EXPECT_TRUE(without([](msg::PointCloud2& cloud) { cloud.fields[3].datatype = 9; }));
  EXPECT_TRUE(without([](msg::PointCloud2& cloud) { cloud.fields[3].count = 2; }));
  EXPECT_TRUE(without([](msg::PointCloud2& cloud) { cloud.is_bigendian = true; }));
}

}  // namespace
}  // namespace pcl_bv::detail
