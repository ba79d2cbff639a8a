// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/messages/livox.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <tuple>

#include "message_bytes.h"
#include "pcl_bv/messages/schema.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv::detail {
namespace {

using test::Encoding;
using Bytes = std::vector<std::byte>;

msg::CustomMsg parse(const std::byte* data, std::size_t size, Encoding encoding) {
  return read_message<msg::CustomMsg>(data, size, encoding == Encoding::ros1);
}
msg::CustomMsg parse(const Bytes& bytes, Encoding encoding) {
  return parse(bytes.data(), bytes.size(), encoding);
}

void expect_points(const PointView& view, std::uint32_t count) {
  ASSERT_EQ(view.count, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const test::LivoxPoint p(i);
    const Coordinates found = load_point(view, i);
    EXPECT_EQ(found.x, static_cast<double>(p.x));
    EXPECT_EQ(found.y, static_cast<double>(p.y));
    EXPECT_EQ(found.z, static_cast<double>(p.z));
  }
}

// Names of every length modulo 8 shift all that follows.
class LivoxMessages : public testing::TestWithParam<std::tuple<Encoding, int>> {
 protected:
  Encoding encoding() const { return std::get<0>(GetParam()); }
  Bytes message(std::uint32_t points) const {
    return test::livox_message(encoding(), points,
                               std::string(static_cast<std::size_t>(std::get<1>(GetParam())), 'f'));
  }
};

INSTANTIATE_TEST_SUITE_P(Encodings, LivoxMessages,
                         testing::Combine(testing::Values(Encoding::cdr, Encoding::big_endian_cdr,
                                                          Encoding::ros1),
                                          testing::Range(0, 8)));

TEST_P(LivoxMessages, HaveTheirPointsTimesAndReflectivities) {
  for (const std::uint32_t points : {1U, 2U, 37U}) {
    const Bytes bytes = message(points);
    const msg::CustomMsg cloud = parse(bytes, encoding());
    EXPECT_EQ(cloud.timebase, 5'000'000'006U);
    EXPECT_EQ(msg::nanoseconds_of(cloud.header.stamp), 5'000'000'006);
    EXPECT_EQ(cloud.lidar_id, 192);
    const auto view = view_points(cloud);
    ASSERT_EQ(view.has_value(), encoding() != Encoding::big_endian_cdr);
    if (!view) continue;
    expect_points(*view, points);
    const std::byte* const last = view->address(points - 1);
    EXPECT_EQ(last + view->readable, bytes.data() + bytes.size())
        << "all of the last point, nothing after it";
    const auto intensity = view_intensity(cloud), times = view_times(cloud);
    ASSERT_TRUE(intensity && times);
    for (std::uint32_t i = 0; i < points; ++i) {
      EXPECT_EQ(intensity->number(i), test::LivoxPoint(i).reflectivity);
      EXPECT_EQ(times->number(i), test::LivoxPoint(i).offset_time);
    }
  }
}

TEST_P(LivoxMessages, AreCopiedWithAllTheirFields) {
  const Bytes bytes = message(37);
  const RawCloud raw = raw_cloud_of(parse(bytes, encoding()));
  expect_points(raw.xyz(), 37);
  const auto times = times_of(raw.fields, raw.data.data(), raw.point_step);
  const auto intensity = intensity_of(raw.fields, raw.data.data(), raw.point_step);
  ASSERT_TRUE(times && intensity);
  const PointField *const tag = find_field(raw, "tag"), *const line = find_field(raw, "line");
  ASSERT_TRUE(tag != nullptr && line != nullptr);
  for (std::uint32_t i = 0; i < 37; ++i) {
    const test::LivoxPoint p(i);
    const std::byte* const record = raw.data.data() + i * raw.point_step;
    EXPECT_EQ(times->number(i), p.offset_time);
    EXPECT_EQ(intensity->number(i), p.reflectivity);
    EXPECT_EQ(record[tag->offset], std::byte{p.tag});
    EXPECT_EQ(record[line->offset], std::byte{p.line});
  }
}

TEST_P(LivoxMessages, WithoutPointsAreEmptyClouds) {
  const Bytes bytes = message(0);
  const msg::CustomMsg cloud = parse(bytes, encoding());
  ASSERT_TRUE(view_points(cloud));
  EXPECT_TRUE(view_points(cloud)->empty());
  EXPECT_FALSE(view_intensity(cloud));
  EXPECT_EQ(raw_cloud_of(cloud).size(), 0U);
  EXPECT_NE(find_field(raw_cloud_of(cloud), "line"), nullptr);
}

// Each size has a buffer of its own, so that a sanitizer sees a read after the end.
TEST_P(LivoxMessages, CutAnywhereAreRefused) {
  const Bytes bytes = message(3);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto cut = std::make_unique<std::byte[]>(std::max<std::size_t>(size, 1));
    std::copy_n(bytes.begin(), size, cut.get());
    EXPECT_THROW(parse(cut.get(), size, encoding()), MessageError) << size;
  }
}

TEST_P(LivoxMessages, ThatAnnounceMorePointsThanTheyHaveAreRefused) {
  Bytes bytes = message(0);
  for (std::size_t i = 1; i <= 4; ++i)
    bytes[bytes.size() - i] = std::byte{0xff};
  EXPECT_THROW(parse(bytes, encoding()), MessageError);
}

TEST(LivoxDefinitions, AreThoseOfBothDrivers) {
  for (const char* type : {msg::CustomMsg::ros_type, msg::CustomMsg::old_ros_type}) {
    const std::string text = schema_of(type);
    EXPECT_THAT(text,
                testing::HasSubstr("uint64 timebase\nuint32 point_num\nuint8 lidar_id\nuint8[3] rsvd\n"));
    EXPECT_THAT(text, testing::HasSubstr("/CustomPoint\nuint32 offset_time\nfloat32 x\n")) << type;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
