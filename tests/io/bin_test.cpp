// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/bin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "files.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv::detail {
namespace {

class Bin : public FileTest {
 protected:
  static std::string bytes_of(const RawCloud& cloud) {
    return {reinterpret_cast<const char*>(cloud.data.data()), cloud.data.size()};
  }
};

TEST_F(Bin, IsReadToTheBit) {
  RawCloud expected = sample_cloud(sample_layouts()[1], 1000, 1, 9);
  expected.viewpoint = RawCloud().viewpoint;
  write_text(file("000001.bin"), bytes_of(expected));
  const RawCloud cloud = read_bin(file("000001.bin"));
  expect_same_cloud(cloud, expected);
  EXPECT_EQ(cloud.xyz().count, 1000u);
  EXPECT_EQ(cloud.xyz().data, cloud.data.data());
  write_pcd(file("a.pcd"), cloud);
  expect_same_cloud(read_cloud(file("a.pcd")), expected);
}

TEST_F(Bin, OfAnyOtherSizeIsTruncated) {
  const std::string whole = bytes_of(sample_cloud(sample_layouts()[1], 3, 1, 9));
  for (std::size_t size = 1; size <= whole.size(); ++size) {
    const std::string expected =
        "truncated: " + std::to_string(size) + " bytes are not a multiple of the 16 bytes of a point";
    EXPECT_EQ(reason_for_content(whole.substr(0, size), ".bin"), size % 16 == 0 ? "" : expected);
  }
}

TEST_F(Bin, ThatCannotBeOpenedSaysWhy) {
  EXPECT_EQ(reason_for(file("gone.bin")), "no such file or directory");
  EXPECT_EQ(reason_for_content("", ".BIN"), "empty file");
}

// A sensor's turn, ring by ring: x, y, z, intensity, ring and more, as floats.
std::vector<float> sweep(std::size_t points, std::size_t fields) {
  std::vector<float> values;
  for (std::size_t i = 0; i < points; ++i) {
    const double angle = 0.003 * static_cast<double>(i), range = 20 + 5 * std::sin(9 * angle);
    const double record[] = {range * std::cos(angle),
                             range * std::sin(angle),
                             -1.7 + 0.01 * std::sin(angle),
                             static_cast<double>(30 + i * 7 % 11),
                             static_cast<double>(i % 32),
                             0.5,
                             100,
                             7};
    for (std::size_t f = 0; f < fields; ++f)
      values.push_back(static_cast<float>(record[f]));
  }
  return values;
}

std::string text_of(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

TEST_F(Bin, OfNuscenesHasFiveFloatsAndARing) {
  write_text(file("sweep.pcd.bin"), text_of(sweep(3200, 5)));
  const RawCloud cloud = read_cloud(file("sweep.pcd.bin"));
  EXPECT_EQ(cloud.size(), 3200U);
  ASSERT_EQ(cloud.fields.size(), 5U);
  EXPECT_EQ(cloud.fields[4].name, "ring");
  EXPECT_EQ(load_point(cloud.xyz(), 3199).x, static_cast<double>(sweep(3200, 5)[3199 * 5]));
}

TEST_F(Bin, OfAnotherNumberOfFloatsIsRefusedWithTheNumberToTry) {
  for (const std::size_t fields : {3UL, 5UL, 6UL, 8UL}) {
    for (const std::size_t points : {32UL, 320UL, 32'000UL}) {
      const std::string number = std::to_string(fields);
      write_text(file("sweep.bin"), text_of(sweep(points, fields)));
      EXPECT_EQ(reason_for(file("sweep.bin")), "with 4 floats per point, successive points jump; " + number +
                                                   " floats per point fit better: try --bin-fields " + number)
          << points;
      EXPECT_EQ(read_bin(file("sweep.bin"), fields).size(), points);
    }
  }
}

TEST_F(Bin, WithLostBeamsIsJudgedByTheOthers) {
  for (const std::size_t fields : {4UL, 6UL}) {
    std::vector<float> values = sweep(3000, fields);
    for (std::size_t i = 0; i < 3000; i += 3)
      std::fill_n(&values[fields * i], 3, std::numeric_limits<float>::quiet_NaN());
    write_text(file("a.bin"), text_of(values));
    EXPECT_EQ(reason_for(file("a.bin")) == "", fields == 4) << fields;
  }
}

TEST_F(Bin, OfFourFloatsIsReadInWhateverOrderItsPointsCome) {
  std::vector<float> values = sweep(4000, 4);
  for (int order = 0; order < 3; ++order) {
    write_text(file("a.bin"), text_of(values));
    EXPECT_EQ(reason_for(file("a.bin")), "") << order;
    std::vector<float> other;
    for (std::size_t i = 0; i < 4000; ++i) {
      const std::size_t from = i * 1709 % 4000;
      other.insert(other.end(), &values[4 * from], &values[4 * from] + 4);
    }
    values = other;
  }
  write_text(file("one.bin"), text_of(sweep(1, 4)));
  EXPECT_EQ(reason_for(file("one.bin")), "");
}

// Points in random order: coordinates of a room, and attributes in 0 to 1, of whole numbers or in -1 to 1.
std::vector<float> room(std::size_t points, std::size_t fields, int attributes) {
  std::mt19937 random(static_cast<unsigned>(7 * fields) + static_cast<unsigned>(attributes));
  const auto between = [&](double low, double high) {
    return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random));
  };
  std::vector<float> values;
  for (std::size_t i = 0; i < points; ++i) {
    values.insert(values.end(), {between(-2, 4), between(1, 8), between(-1.5, 1.6)});
    for (std::size_t f = 3; f < fields; ++f)
      values.push_back(attributes == 0   ? between(0, 1)
                       : attributes == 1 ? std::floor(between(0, 256))
                                         : between(-1, 1));
  }
  return values;
}

TEST_F(Bin, OfAnotherNumberOfFloatsInRandomOrderIsRefusedWithTheNumberToTry) {
  for (const std::size_t fields : {3UL, 5UL, 6UL, 7UL, 8UL, 9UL}) {
    for (const int attributes : {0, 1, 2}) {
      write_text(file("room.bin"), text_of(room(3000, fields, attributes)));
      EXPECT_THAT(
          reason_for(file("room.bin")),
          testing::EndsWith("floats per point fit better: try --bin-fields " + std::to_string(fields)))
          << attributes;
      EXPECT_EQ(read_bin(file("room.bin"), fields).size(), 3000U);
    }
  }
}

TEST_F(Bin, OfFourFloatsIsReadAlsoIfBeamsAlternate) {
  for (const int attributes : {0, 1, 2}) {
    write_text(file("room.bin"), text_of(room(6300, 4, attributes)));  // 3, 5, 6, 7 and 9 divide its size
    EXPECT_EQ(reason_for(file("room.bin")), "") << attributes;
  }
  for (const std::size_t beams : {3UL, 5UL, 7UL, 40UL, 63UL}) {
    std::vector<float> values;
    for (std::size_t i = 0; i < 6300; ++i) {
      const double angle = 0.001 * static_cast<double>(i / beams);
      const double tilt = 0.4 * (static_cast<double>(i * 7 % beams) / static_cast<double>(beams) - 0.5);
      const double range = tilt < 0 ? 1.7 / -tilt : 30;
      for (const double value : {range * std::cos(angle), range * std::sin(angle), range * tilt, 0.3 + tilt})
        values.push_back(static_cast<float>(value));
    }
    write_text(file("beams.bin"), text_of(values));
    EXPECT_EQ(reason_for(file("beams.bin")), "") << beams;
  }
}

TEST_F(Bin, OfWhatIsNoFloatsIsRefused) {
  std::vector<double> doubles;
  for (const float value : sweep(300, 4))
    doubles.push_back(static_cast<double>(value));
  const std::string as_text(reinterpret_cast<const char*>(doubles.data()), doubles.size() * sizeof(double));
  EXPECT_NE(reason_for_content(as_text, ".bin"), "");
  const std::vector<float> nothing(400, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(reason_for_content(text_of(nothing), ".bin"),
            "with 4 floats per point, most values are not plausible coordinates: probably not a .bin point "
            "cloud");
}

TEST_F(Bin, WithAnImpossibleNumberOfFieldsIsWrongUse) {
  write_text(file("a.bin"), text_of(sweep(300, 4)));
  for (const std::size_t fields : {1UL, 2UL, 33UL})
    EXPECT_THROW(read_bin(file("a.bin"), fields), std::invalid_argument);
  EXPECT_EQ(read_bin(file("a.bin"), 3).size(), 400U);
}

}  // namespace
}  // namespace pcl_bv::detail
