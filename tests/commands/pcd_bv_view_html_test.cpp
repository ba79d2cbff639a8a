// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is in the pages of --view-html. That a browser shows it is tests/live.

#include <gmock/gmock.h>

#include <algorithm>
#include <boost/beast/core/detail/base64.hpp>
#include <cstdint>
#include <cstring>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

struct Shown {
  Json data;
  std::vector<float> xyz;  // relative to data["origin"]
  std::vector<std::uint32_t> labels;
  std::vector<float> intensity;
};

Shown read_page(const std::string& file) {
  const std::string page = read_file(file), begin = "<script id=\"data\" type=\"application/json\">";
  const std::size_t first = page.find(begin) + begin.size();
  Shown shown;
  shown.data = Json::parse(page.substr(first, page.find("</script>", first) - first));
  const std::string text = shown.data["points"];
  namespace base64 = boost::beast::detail::base64;
  std::string bytes(base64::decoded_size(text.size()), '\0');
  bytes.resize(base64::decode(bytes.data(), text.data(), text.size()).first);
  const std::size_t stride = shown.data["stride"];
  EXPECT_EQ(bytes.size(), stride * shown.data["shown"].get<std::size_t>());
  for (std::size_t at = 0; at + stride <= bytes.size(); at += stride) {
    float xyz[3], intensity = 0;
    std::uint32_t label = 0;
    std::memcpy(xyz, bytes.data() + at, 12);
    std::memcpy(&label, bytes.data() + at + 12, 4);
    if (stride == 20) std::memcpy(&intensity, bytes.data() + at + 16, 4);
    shown.xyz.insert(shown.xyz.end(), xyz, xyz + 3);
    shown.labels.push_back(label);
    shown.intensity.push_back(intensity);
  }
  return shown;
}

using PcdBvViewHtml = PcdBv;

TEST_F(PcdBvViewHtml, HoldsTheReportAndThePointsWithTheirClusters) {
  const std::string cloud =
      ascii("a.pcd", {"0 0 0", "0.1 0 0", "nan 0 0", "9 0 0", "9.1 0 0", "9.2 0 0", "50 0 0"});
  const Result result =
      run({"--cluster", "0.5", "--min-size", "2", "--format", "json", "--view-html", at("a.html"), cloud});
  ASSERT_EQ(result.status, 0) << result.err;
  const Shown shown = read_page(at("a.html"));
  EXPECT_EQ(shown.data["report"], result.json()[0]);
  EXPECT_EQ(shown.data["shown"], 6);
  EXPECT_EQ(shown.data["of"], 7);
  EXPECT_EQ(shown.data["stride"], 16);
  EXPECT_EQ(shown.data["up"], Json({0, 0, 1}));
  EXPECT_EQ(shown.data["origin"], Json({5, 0, 0}));
  EXPECT_EQ(shown.labels, (std::vector<std::uint32_t>{1, 1, 0, 0, 0, 4294967295}));
  const std::vector<float> x{0, 0.1F, 9, 9.1F, 9.2F, 50};
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(shown.xyz[3 * i], static_cast<float>(double{x[i]} - 5));
}

TEST_F(PcdBvViewHtml, OfAWholeCloudAllPointsAreTheObjectAndGroundIsToldApart) {
  ASSERT_EQ(run({"--view-html", at("all.html"), "synth:street:5000"}).status, 0);
  const Shown all = read_page(at("all.html"));
  EXPECT_GT(all.labels.size(), 4900U);
  EXPECT_EQ(all.labels, std::vector<std::uint32_t>(all.labels.size(), 0));
  ASSERT_EQ(
      run({"--ground", "zones", "--range", "0.5:1000", "--view-html", at("ground.html"), "synth:street:5000"})
          .status,
      0);
  const Shown ground = read_page(at("ground.html"));
  EXPECT_EQ(std::count(ground.labels.begin(), ground.labels.end(), 4294967294U),
            ground.data["report"]["counts"]["ground"].get<std::ptrdiff_t>());
}

TEST_F(PcdBvViewHtml, ShowsAtMostHalfAMillionPointsOfEveryPartOfTheCloud) {
  ASSERT_EQ(run({"--view-html", at("a.html"), "synth:gauss:1000001"}).status, 0);
  const Shown shown = read_page(at("a.html"));
  EXPECT_EQ(shown.data["shown"], 500'000);
  EXPECT_EQ(shown.data["of"], 1'000'001);
}

TEST_F(PcdBvViewHtml, KeepsMillimetresOfUtmCoordinatesAndTheIntensity) {
  const std::string header =
      "VERSION 0.7\nFIELDS x y z intensity\nSIZE 8 8 8 4\nTYPE F F F F\nWIDTH 2\nHEIGHT 1\nDATA ascii\n";
  const std::string cloud =
      file("utm.pcd", header + "500000.001 5000000.002 100 7\n500010.003 5000020.004 100 250\n");
  ASSERT_EQ(run({"--view-html", at("a.html"), cloud}).status, 0);
  const Shown shown = read_page(at("a.html"));
  EXPECT_EQ(shown.intensity, (std::vector<float>{7, 250}));
  EXPECT_NEAR(shown.data["origin"][1].get<double>() + shown.xyz[4], 5000020.004, 1e-5);
}

TEST_F(PcdBvViewHtml, AHostileNameStaysText) {
  const std::string cloud = ascii("<script>alert(1)<!--.pcd", {"0 0 0", "1 1 1"});
  ASSERT_EQ(run({"--view-html", at("a.html"), cloud}).status, 0);
  const std::string page = read_file(at("a.html"));
  EXPECT_EQ(page.find("alert(1)"), page.find("\\u003cscript>alert(1)\\u003c!--.pcd") + 13);
  EXPECT_EQ(read_page(at("a.html")).data["report"]["file"], cloud);
}

TEST_F(PcdBvViewHtml, OfSeveralInputsThereIsAPageForEachAndNoneForAFailedOne) {
  const std::string cloud = ascii("a.pcd", {"0 0 0"}), empty = ascii("b.pcd", {"nan nan nan"});
  const Result result = run({"--view-html", at("pages"), cloud, empty, file("c.pcd", "no cloud")});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(read_page(at("pages/a.html")).data["shown"], 1);
  EXPECT_EQ(read_page(at("pages/b.html")).data["shown"], 0);
  EXPECT_FALSE(std::filesystem::exists(at("pages/c.html")));
  EXPECT_EQ(run({"--view-html", at("a.htm"), cloud}).err,
            "pcd_bv: --view-html: '" + at("a.htm") + "' is no .html file\n");
  const Result unwritable = run({"--view-html", cloud + "/a.html", cloud});
  EXPECT_EQ(unwritable.status, 1);
  EXPECT_THAT(unwritable.err, HasSubstr(cloud + "/a.html: "));
}

}  // namespace
}  // namespace pcl_bv::test
