// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The page with one cloud inside: what clicks, keys and strange texts do.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "page_scene.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

TEST_F(Page, PickingGivesTheObjectUnderThePixel) {
  std::vector<std::vector<AnyVolume>> clusters;
  std::vector<Vector3d> middles;
  for (const char* method :
       {"aabb", "dop26", "sphere", "obb", "cylinder", "capsule", "ellipsoid", "prism", "hull"}) {
    const auto number = static_cast<int>(clusters.size());
    const Vector3d at(8 * (number % 4), 8 * (number / 4), 0);
    clusters.push_back({fitted(method, lump(at, 2))});
    middles.push_back(center(clusters.back().front()));
  }
  // Around all of them, so that each ray meets it first.
  clusters.push_back({Aabb({-20, -20, -20}, {40, 30, 20})});
  show(report_of(clusters));
  const std::vector<Vector2d> at = project(middles);
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const std::string place = std::to_string(at[i].x()) + ", " + std::to_string(at[i].y());
    EXPECT_EQ(browser.run("return pclBv.pick(" + place + ")"), "cluster " + std::to_string(i));
  }
  browser.click(at[2].x(), at[2].y());
  browser.until("pclBv.picked === 'cluster 2'");
  browser.press("p");
  browser.until("pclBv.state.panel && document.getElementById('picked-rows').children.length > 0");
  const auto text = browser.run("return document.getElementById('picked-rows').innerText").get<std::string>();
  EXPECT_THAT(text, testing::HasSubstr("sphere"));
  EXPECT_THAT(text, testing::HasSubstr("radius"));
  browser.press("Escape");
  browser.until("pclBv.picked === null");
}

TEST_F(Page, NothingIsPickedWhereNothingIs) {
  show(report_of({{Aabb({-1, -1, -1}, {1, 1, 1})}}), {{9, 9, 9, no_label}, {-9, -9, -9, no_label}});
  EXPECT_EQ(browser.run("return pclBv.pick(20, 100)"), nullptr);
  const Vector2d middle = project({{0, 0, 0}}).front();
  browser.click(middle.x(), middle.y());
  browser.until("pclBv.picked === 'cluster 0'");
  browser.click(20, 100);
  browser.until("pclBv.picked === null");
}

TEST_F(Page, HostileStringsStayText) {
  const std::string evil = "</script><img src=x onerror=\"window.broken=1\"><script>window.broken=1</script>";
  Json report = report_of({{Aabb({-1, -1, -1}, {1, 1, 1})}});
  report["file"] = report["frame_id"] = evil;
  report["clusters"][0]["class"] = evil;
  report["clusters"][0]["volumes"][0]["method"] = evil;
  report["clusters"][0]["volumes"].push_back({{"shape", "sphere"}, {"method", "sphere"}, {"failed", evil}});
  show(report);
  browser.press("p");
  browser.press("l");
  const Vector2d middle = project({{0, 0, 0}}).front();
  browser.click(middle.x(), middle.y());
  browser.until("pclBv.picked === 'cluster 0' && document.getElementById('picked-rows').children.length > 0");
  EXPECT_EQ(browser.run("return document.querySelectorAll('img').length"), 0);
  EXPECT_EQ(browser.run("return typeof window.broken"), "undefined");
  EXPECT_EQ(browser.run("return document.querySelectorAll('script').length"), 2);
  const auto text = browser.run("return document.body.innerText").get<std::string>();
  EXPECT_THAT(text, testing::HasSubstr(evil));
}

TEST_F(Page, KeysChangeWhatIsShown) {
  show(report_of({{Aabb({-1, -1, -1}, {1, 1, 1})}}), {{3, 3, 3, no_label}, {-3, -3, -3, 0}});
  browser.press("c");
  browser.until("pclBv.state.mode === 'height'");
  browser.press("c");
  browser.until("pclBv.state.mode === 'cluster'");
  browser.press("d");
  browser.until("pclBv.state.theme === 'light'");
  browser.press("+");
  browser.until("pclBv.state.pointSize === 3");
  browser.press("h");
  browser.until("!document.getElementById('help-text').hidden");
  browser.press("Escape");
  browser.until("document.getElementById('help-text').hidden");
  browser.press("1");
  std::vector<Vector2d> at = project({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_NEAR((at[3] - at[0]).norm(), 0, 1e-6) << "from the top";
  EXPECT_GT(at[1].x(), at[0].x() + 20);
  EXPECT_LT(at[2].y(), at[0].y() - 20);
  browser.press("2");
  at = project({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_NEAR((at[2] - at[0]).norm(), 0, 1e-6) << "along y";
  EXPECT_GT(at[1].x(), at[0].x() + 20);
  EXPECT_LT(at[3].y(), at[0].y() - 20);
  browser.press("3");
  at = project({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_NEAR((at[1] - at[0]).norm(), 0, 1e-6) << "against x";
  EXPECT_GT(at[2].x(), at[0].x() + 20);
}

TEST_F(Page, AsksForNothingOverTheNetwork) {
  show(report_of({{Aabb({-1, -1, -1}, {1, 1, 1})}}));
  EXPECT_EQ(browser.run("return performance.getEntriesByType('resource').length"), 0);
  EXPECT_LT(live_page().size(), 100'000U);
}

TEST_F(Page, TellsHowManyOfThePointsItShows) {
  show(report_of({{Aabb({-1, -1, -1}, {1, 1, 1})}}), {{3, 3, 3, no_label}}, {0, 0, 0}, 1234567);
  const auto text =
      browser.run("return document.getElementById('frame-text').textContent").get<std::string>();
  EXPECT_THAT(text, testing::HasSubstr("1 of 1234567 points shown"));
}

TEST_F(Page, OfAFileHasNothingOfAConnection) {
  show(report_of({{Aabb({-1, -1, -1}, {1, 1, 1})}}));
  browser.press(" ");  // nothing to pause
  const Json shown = browser.run(
      "return ['pause', 'banner', 'settings-section', 'stage-plot']"
      ".map((id) => document.getElementById(id).getClientRects().length)");
  EXPECT_EQ(shown, Json({0, 0, 0, 0}));
  EXPECT_EQ(browser.run("return [pclBv.connected, pclBv.state.paused]"), Json({false, false}));
}

}  // namespace
}  // namespace pcl_bv::test
