// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How many points a .las file has, where its header says it more than once.
#include <gtest/gtest.h>

#include "files.h"
#include "las_bytes.h"
#include "pcl_bv/io/las.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {
namespace {

class LasCounts : public FileTest {
 protected:
  RawCloud read(const std::string& bytes) const {
    write_text(file("a.las"), bytes);
    RawCloud cloud = read_las(file("a.las"));
    const CloudHeader header = read_cloud_header(file("a.las"));
    EXPECT_EQ(header.cloud.size(), cloud.size());
    EXPECT_EQ(header.cloud.note, cloud.note);
    return cloud;
  }

  std::string reason(const std::string& bytes) const { return reason_for_content(bytes, ".las"); }

  /// With an extended record of some bytes behind the points, which the header names.
  static std::string with_record(std::string bytes, std::size_t payload) {
    LasFile::put<std::uint64_t>(bytes, 235, bytes.size());
    LasFile::put<std::uint32_t>(bytes, 243, 1);
    std::string record(60 + payload, 'e');
    LasFile::put<std::uint64_t>(record, 20, payload);
    return bytes + record;
  }

  static std::string with_legacy(std::string bytes, std::uint32_t count) {
    LasFile::put(bytes, 107, count);
    return bytes;
  }
  static std::string with_count(std::string bytes, std::uint64_t count) {
    LasFile::put(bytes, 247, count);
    return bytes;
  }
};

const LasFile kWide{4, 6, 30, 4};
const LasFile kNarrow{4, 1, 28, 4};

TEST_F(LasCounts, OfVersion14AreThoseOf64BitsNotTheLegacyOnes) {
  const std::string note =
      "the header has a legacy count of 6 points and a 64-bit count of 4; the 64-bit count is used";
  for (const LasFile& las : {kWide, kNarrow, LasFile{5, 7, 36, 4}}) {
    for (const std::size_t payload : {0U, 1000U}) {
      const RawCloud cloud = read(with_legacy(with_record(las.bytes(), payload), 6));
      EXPECT_EQ(cloud.size(), 4U);
      EXPECT_EQ(cloud.note, note);
    }
    EXPECT_EQ(read(with_legacy(las.bytes(), 6)).size(), 4U);
    EXPECT_EQ(read(with_legacy(las.bytes(), 3)).size(), 4U);
    EXPECT_EQ(read(with_legacy(las.bytes(), 0)).note, "");
  }
}

TEST_F(LasCounts, ThatAWriterLeftZeroAreTheLegacyOnesWhereThoseMeanAnything) {
  const RawCloud cloud = read(with_count(kNarrow.bytes(), 0));
  EXPECT_EQ(cloud.size(), 4U);
  EXPECT_EQ(cloud.note,
            "the header has a legacy count of 4 points and a 64-bit count of 0; the legacy count is used");
  EXPECT_EQ(reason(with_legacy(with_count(kWide.bytes(), 0), 4)),
            "header: 0 points, but 120 more bytes (4 points) follow");
}

TEST_F(LasCounts, ThatAreTooSmallAreSaid) {
  const std::string note = "the header says 3 points; 30 more bytes (1 point) follow, which are not read";
  EXPECT_EQ(read(with_count(kWide.bytes(), 3)).note, note);
  EXPECT_EQ(read(with_record(with_count(kWide.bytes(), 3), 500)).note, note);
  EXPECT_EQ(read(with_record(kWide.bytes(), 500)).note, "");
  const std::string old = LasFile{2, 0, 20, 4}.bytes();
  EXPECT_EQ(read(old + std::string(19, 'x')).note, "");
  EXPECT_NE(read(old + std::string(20, 'x')).note, "");
  EXPECT_EQ(reason(with_legacy(old, 0)), "header: 0 points, but 80 more bytes (4 points) follow");
}

TEST_F(LasCounts, ThatReachIntoOtherRecordsAreRefused) {
  const std::string where = std::to_string(kWide.bytes().size());
  EXPECT_EQ(reason(with_count(with_record(kWide.bytes(), 500), 6)),
            "header: 6 points of 30 bytes from byte " + std::to_string(kWide.first_record()) +
                " on, but other records begin at byte " + where);
  // No record begins there: an offset that was not kept up to date.
  std::string stale = LasFile{4, 6, 30, 400}.bytes();
  LasFile::put<std::uint64_t>(stale, 235, kWide.first_record() + 120);
  LasFile::put<std::uint32_t>(stale, 243, 1);
  for (std::size_t i = 0; i < 8; ++i)
    stale[kWide.first_record() + 120 + 20 + i] = '\x7f';
  EXPECT_EQ(read(stale).size(), 400U);
}

TEST_F(LasCounts, BeforeWaveformsEndThere) {
  std::string bytes = LasFile{3, 4, 57, 4}.bytes();
  LasFile::put<std::uint64_t>(bytes, 227, bytes.size());
  std::string waveforms(60 + 500, 'w');
  LasFile::put<std::uint64_t>(waveforms, 20, 500);
  const RawCloud cloud = read(bytes + waveforms);
  EXPECT_EQ(cloud.size(), 4U);
  EXPECT_EQ(cloud.note, "");
}

TEST_F(LasCounts, AndTheBoxInTheHeaderAreIndependent) {
  std::string bytes = LasFile{2, 0, 20, 4}.bytes();
  for (std::size_t at = 179; at < 227; at += 8)
    LasFile::put(bytes, at, 1e300);
  EXPECT_EQ(read(bytes).size(), 4U);
}

// Returns the file with a record of its coordinate system in place of its empty one.
std::string with_record_of(std::uint16_t id, const std::string& content) {
  const LasFile las{2, 0, 20, 3};
  const std::string bytes = las.bytes(), points = bytes.substr(las.first_record());
  std::string record(54, '\0');
  record.replace(2, 15, "LASF_Projection");
  LasFile::put(record, 18, id);
  LasFile::put(record, 20, static_cast<std::uint16_t>(content.size()));
  std::string all = bytes.substr(0, 227) + record + content;
  LasFile::put(all, 96, static_cast<std::uint32_t>(all.size()));
  return all + points;
}

std::string geo_keys(std::uint16_t key, std::uint16_t value) {
  const std::vector<std::uint16_t> keys{1, 1, 0, 2, 1025, 0, 1, 1, key, 0, 1, value};
  return {reinterpret_cast<const char*>(keys.data()), 2 * keys.size()};
}

TEST_F(LasCounts, UnitsOtherThanMetresHaveAWarning) {
  const std::string feet =
                        "coordinates are in feet (the coordinate system of the file): distances and "
                        "tolerances are feet, too",
                    degrees =
                        "x and y are longitude and latitude: all distances in their plane are in degrees",
                    projected = R"(PROJCS["a",GEOGCS["b",UNIT["degree",0.0174]],UNIT["metre",1]])";
  EXPECT_EQ(read(with_record_of(34735, geo_keys(3076, 9001))).note, "");
  EXPECT_EQ(read(with_record_of(34735, geo_keys(3076, 9003))).note, feet);
  EXPECT_EQ(read(with_record_of(34735, geo_keys(4099, 9002))).note, feet);
  EXPECT_EQ(read(with_record_of(34735, geo_keys(1024, 2))).note, degrees);
  EXPECT_EQ(read(with_record_of(34735, geo_keys(3076, 9003).substr(0, 20))).note, "");
  EXPECT_EQ(read(with_record_of(2112, projected)).note, "");
  EXPECT_EQ(read(with_record_of(2112, R"(PROJCS["a",GEOGCS["b"],UNIT["US survey foot",0.3048006]])")).note,
            feet);
  EXPECT_EQ(read(with_record_of(2112, R"(GEOGCS["b",UNIT["degree",0.0174]])")).note, degrees);
  EXPECT_EQ(read(with_record_of(2111, R"(GEOGCS["b"])")).note, "");
}

}  // namespace
}  // namespace pcl_bv::detail
