// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "files.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/report/read_volumes.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv {
namespace {

using testing::HasSubstr;

class ReadVolumes : public FileTest {
 protected:
  std::vector<AnyVolume> read(const std::string& text) const {
    write_text(file("volumes.json"), text);
    return read_volumes(file("volumes.json"));
  }
  std::string error_of(const std::string& text) const {
    try {
      static_cast<void>(read(text));
    } catch (const IoError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(ReadVolumes, AreThoseOfTheReportBitByBit) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> xyz(3 * 200);
  for (double& coordinate : xyz)
    coordinate = 1e3 + normal(random) / 3;
  const PointView points = PointView::of(xyz.data(), 3 * sizeof(double), xyz.size() / 3);
  Report report;
  report.file = "a.pcd";
  report.clusters.resize(1);
  for (const Method& method : methods()) {
    VolumeEntry entry;
    entry.method = method.name;
    method.fit(points, entry.volume, {});
    report.clusters[0].volumes.push_back(entry);
  }
  const std::vector<AnyVolume> found = read(report_json(report) + "\n" + report_json(report) + "\n");
  ASSERT_EQ(found.size(), 2 * methods().size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(found[i] == report.clusters[0].volumes[i % methods().size()].volume) << i;
}

TEST_F(ReadVolumes, MayBeWrittenByHand) {
  const auto found = read(R"([{"shape":"sphere","center":[1,2,3],"radius":0.5},
                              {"shape":"aabb","min":[0,0,0],"max":[1,1,1]}, {"shape":"hull","empty":true}])");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(found[0] == AnyVolume(Sphere({1, 2, 3}, 0.5)));
  EXPECT_TRUE(found[1] == AnyVolume(Aabb({0, 0, 0}, {1, 1, 1})));
}

TEST_F(ReadVolumes, SayWhatIsWrong) {
  EXPECT_THAT(error_of("{}"), HasSubstr("no volumes"));
  EXPECT_THAT(error_of("not json"), HasSubstr("volumes.json: "));
  EXPECT_THAT(error_of(R"({"shape":"blob"})"), HasSubstr("'blob' is no shape"));
  EXPECT_THAT(error_of(R"({"shape":"sphere","center":[1,2,3]})"), HasSubstr("radius"));
  EXPECT_THAT(error_of(R"({"shape":"sphere","center":[1,2],"radius":1})"), HasSubstr("three numbers"));
  EXPECT_THAT(error_of(R"({"shape":"sphere","center":[1,2,"x"],"radius":1})"), HasSubstr("volumes.json: "));
  EXPECT_THROW(read_volumes("/nonexistent.json"), IoError);
}

}  // namespace
}  // namespace pcl_bv
