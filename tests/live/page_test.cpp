// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The page with one cloud inside, looked at through a browser: where its pixels are, and what clicks and keys
// do.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "browser.h"
#include "page.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv::test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using Json = nlohmann::json;

constexpr std::uint32_t no_label = 4294967295;

struct LabelledPoint {
  float x, y, z;
  std::uint32_t label;
};

// A page of its own file around a report.
class PageFile {
 public:
  PageFile(Json report, const std::vector<LabelledPoint>& points, const Vector3d& origin, std::size_t of) {
    std::string bytes(points.size() * sizeof(LabelledPoint), '\0');
    if (!points.empty()) std::memcpy(bytes.data(), points.data(), bytes.size());
    const Json data = {{"report", std::move(report)},
                       {"origin", {origin.x(), origin.y(), origin.z()}},
                       {"shown", points.size()},
                       {"of", std::max(of, points.size())},
                       {"stride", sizeof(LabelledPoint)},
                       {"points", base64(bytes)},
                       {"up", {0, 0, 1}}};
    std::string text = data.dump();
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;)
      text.replace(at, 1, "\\u003c");
    std::string page(live_page());
    page.replace(page.find(kPageData), kPageData.size(),
                 R"(<script id="data" type="application/json">)" + text + "</script>");
    std::ofstream(path_) << page;
  }
  ~PageFile() { std::filesystem::remove(path_); }
  PageFile(const PageFile&) = delete;
  PageFile& operator=(const PageFile&) = delete;

  std::string url() const { return "file://" + path_.string(); }

 private:
  static int next() {
    static int files = 0;
    return files++;
  }

  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() /
      ("pcl_bv_page_" + std::to_string(getpid()) + "_" + std::to_string(next()) + ".html");
};

Json report_of(const std::vector<std::vector<AnyVolume>>& clusters) {
  Report report;
  report.file = "test.pcd";
  for (const std::vector<AnyVolume>& volumes : clusters) {
    ClusterEntry cluster{report.clusters.size(), 100, {}};
    for (const AnyVolume& volume : volumes)
      cluster.volumes.push_back({std::string(shape_name(volume)), volume, {}});
    report.clusters.push_back(std::move(cluster));
  }
  return Json::parse(report_json(report));
}

AnyVolume fitted(std::string_view method, const std::vector<float>& xyz) {
  AnyVolume volume;
  find_method(method)->fit(PointView::of(xyz.data(), 12, xyz.size() / 3), volume, Execution());
  return volume;
}

// Points that no shape fits well, longer than wide and askew.
std::vector<float> lump(const Vector3d& at, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<float> xyz;
  for (int i = 0; i < 200; ++i) {
    const float a = normal(random), b = normal(random), c = normal(random);
    const Vector3d p = at + Vector3d(a + 0.4F * b, 0.5F * b - 0.3F * a, 0.3F * c + 0.2F * a);
    for (int k = 0; k < 3; ++k)
      xyz.push_back(static_cast<float>(p[k]));
  }
  return xyz;
}

struct Page : testing::Test {
  Browser browser{800, 600};
  std::unique_ptr<PageFile> file;

  // Opens the page in the dark, with nothing beside points and volumes in the scene.
  void show(Json report, const std::vector<LabelledPoint>& points = {}, const Vector3d& origin = {0, 0, 0},
            std::size_t of = 0) {
    browser.prefer("dark");
    file = std::make_unique<PageFile>(std::move(report), points, origin, of);
    browser.open(file->url());
    browser.until("window.pclBv && pclBv.frames === 1");
    for (const char* key : {"g", "l"})
      browser.press(key);
    browser.until("!pclBv.state.grid && !pclBv.state.labels");
  }

  std::vector<Vector2d> project(const std::vector<Vector3d>& points) {
    Json list = Json::array();
    for (const Vector3d& p : points)
      list.push_back({p.x(), p.y(), p.z()});
    std::vector<Vector2d> pixels;
    for (const Json& at : browser.run("return " + list.dump() + ".map((p) => pclBv.project(...p))"))
      pixels.emplace_back(at.at(0).get<double>(), at.at(1).get<double>());
    return pixels;
  }

  // What the browser has drawn: two pictures alike, a while apart.
  Picture settled() {
    Picture before = browser.screenshot();
    for (;;) {
      browser.run("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
      Picture now = browser.screenshot();
      if (now.rgba == before.rgba) return now;
      before = std::move(now);
    }
  }
};

// How far a pixel is from the dark ground; 0 on it.
int above_ground(const std::uint8_t* rgba) {
  return std::max({std::abs(rgba[0] - 14), std::abs(rgba[1] - 17), std::abs(rgba[2] - 22)});
}

// The scene without the bar above it, the axes and the scale.
bool in_scene(int x, int y) {
  return y > 45 && y < 530 && x > 2 && x < 797;
}

// The brightest within a pixel of there.
int brightest(const Picture& picture, const Vector2d& at) {
  int most = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const auto [x, y] =
          std::pair(static_cast<int>(std::floor(at.x())) + dx, static_cast<int>(std::floor(at.y())) + dy);
      if (in_scene(x, y)) most = std::max(most, above_ground(picture.at(x, y)));
    }
  }
  return most;
}

// Blue rather than red, or the reverse: the colours of objects 0 and 1.
bool is_blue(const std::uint8_t* rgba) {
  return rgba[2] > rgba[0];
}

// The outline of points, counter-clockwise (Andrew's monotone chain).
std::vector<Vector2d> outline(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  std::vector<Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t first = hull.size();
    for (const Vector2d& p : points) {
      const auto turns_right = [&] {
        const Vector2d a = hull[hull.size() - 1] - hull[hull.size() - 2], b = p - hull[hull.size() - 2];
        return a.x() * b.y() - a.y() * b.x() <= 0;
      };
      while (hull.size() >= first + 2 && turns_right())
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// How far outside of the outline a pixel's middle is; negative inside.
double outside(const std::vector<Vector2d>& hull, int x, int y) {
  double most = -1e9;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d& a = hull[i];
    const Vector2d way = (hull[(i + 1) % hull.size()] - a).normalized();
    const Vector2d from = Vector2d(x + 0.5, y + 0.5) - a;
    most = std::max(most, way.y() * from.x() - way.x() * from.y());
  }
  return most;
}

// Points all over the surface, by the library's own support function. Corners with hardly a direction of
// their own come from the mesh, which is exact for what has flat sides.
std::vector<Vector3d> surface(const AnyVolume& volume) {
  std::vector<Vector3d> points;
  if (shape_name(volume) == "aabb" || shape_name(volume) == "kdop" || shape_name(volume) == "obb" ||
      shape_name(volume) == "hull")
    return mesh(volume).vertices;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j <= 30; ++j) {
      const double a = 2 * M_PI * i / 60, b = M_PI * (j / 30.0 - 0.5);
      points.push_back(support(volume, {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)}));
    }
  }
  return points;
}

TEST_F(Page, EdgesOfABoxAndPointsStandWhereProjectSays) {
  const std::vector<LabelledPoint> points = {{3, 0, 0, no_label},
                                             {-3, 0, 0.5, no_label},
                                             {0, 3, 0, no_label},
                                             {0, -3, -1, no_label},
                                             {0, 0, 3, no_label}};
  show(report_of({{Aabb({-1, -1, -1}, {1, 1, 1})}}), points);
  browser.press("v");
  browser.until("!pclBv.state.faces");
  const Picture picture = settled();
  std::vector<Vector3d> edges, places;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int corner : {0, 1, 2, 3}) {
      Vector3d middle = Vector3d::Zero();
      middle[(axis + 1) % 3] = corner & 1 ? 1 : -1;
      middle[(axis + 2) % 3] = corner & 2 ? 1 : -1;
      edges.push_back(middle);
    }
  }
  for (const LabelledPoint& p : points)
    places.emplace_back(p.x, p.y, p.z);
  for (const Vector2d& at : project(edges))
    EXPECT_GT(brightest(picture, at), 100) << at.transpose();
  for (const Vector2d& at : project(places)) {
    EXPECT_GT(brightest(picture, at), 50) << at.transpose();
    EXPECT_EQ(brightest(picture, at + Vector2d(6, 6)), 0) << at.transpose();
  }
  for (const Vector2d& at : project({{0.5, 0.5, 1}, {1, 0, 0.4}, {-0.3, -1, -0.2}}))
    EXPECT_EQ(brightest(picture, at), 0) << "faces are off: " << at.transpose();
}

struct Shapes : Page, testing::WithParamInterface<const char*> {};

TEST_P(Shapes, FillTheirSilhouetteAndNothingElse) {
  const AnyVolume volume = fitted(GetParam(), lump({0.5, -0.25, 0.125}, 1));
  show(report_of({{volume}}));
  // All of it in the picture: without points the view is fitted to the middle alone.
  for (int turns = 0; turns < 40; ++turns) {
    const std::vector<Vector2d> reach = project(surface(volume));
    if (std::all_of(reach.begin(), reach.end(),
                    [](const Vector2d& p) { return in_scene(int(p.x()), int(p.y())); }))
      break;
    browser.wheel(400, 300, 200);
  }
  const Picture picture = settled();
  const std::vector<Vector2d> hull = outline(project(surface(volume)));
  int inside = 0, holes = 0, strays = 0, of_other_colour = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!in_scene(x, y)) continue;
      const double off = outside(hull, x, y);
      const int bright = above_ground(picture.at(x, y));
      if (off < -2.5) {
        ++inside;
        holes += bright < 5;
        of_other_colour += !is_blue(picture.at(x, y));
      }
      strays += off > 2.5 && bright > 0;
    }
  }
  EXPECT_GT(inside, 5000);
  EXPECT_EQ(holes, 0);
  EXPECT_EQ(strays, 0);
  EXPECT_EQ(of_other_colour, 0);
}

INSTANTIATE_TEST_SUITE_P(Page, Shapes,
                         testing::Values("aabb", "dop26", "sphere", "obb", "cylinder", "capsule", "ellipsoid",
                                         "hull"),
                         [](const auto& shape) { return std::string(shape.param); });

TEST_F(Page, PickingGivesTheObjectUnderThePixel) {
  std::vector<std::vector<AnyVolume>> clusters;
  std::vector<Vector3d> middles;
  for (const char* method : {"aabb", "dop26", "sphere", "obb", "cylinder", "capsule", "ellipsoid", "hull"}) {
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
  browser.until("pclBv.state.panel");
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

TEST_F(Page, CoordinatesOfUtmSizeDrawAsSmallOnesDo) {
  const Vector3d far(500123, 4500321, 512);
  std::vector<std::vector<AnyVolume>> near_clusters, far_clusters;
  for (const char* method : {"aabb", "dop26", "sphere", "obb", "cylinder", "capsule", "ellipsoid", "hull"}) {
    const Vector3d at(6 * static_cast<int>(near_clusters.size()), 0, 0);
    near_clusters.push_back({fitted(method, lump(at, 3))});
    Eigen::Isometry3d shift = Eigen::Isometry3d::Identity();
    shift.translation() = far;
    far_clusters.push_back({transformed(near_clusters.back().front(), shift)});
  }
  const std::vector<LabelledPoint> points = {{-5, -5, 0, no_label}, {50, 5, 2, no_label}, {20, 3, 1, 2}};
  show(report_of(near_clusters), points);
  const Picture small = settled();
  show(report_of(far_clusters), points, far);
  const Picture large = settled();
  int different = 0, drawn = 0;
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      if (!in_scene(x, y)) continue;
      drawn += above_ground(small.at(x, y)) > 0;
      for (int k = 0; k < 3; ++k)
        different += std::abs(small.at(x, y)[k] - large.at(x, y)[k]) > 24;
    }
  }
  EXPECT_GT(drawn, 2000);
  EXPECT_LT(different, 10);
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
  browser.until("pclBv.picked === 'cluster 0'");
  EXPECT_EQ(browser.run("return document.querySelectorAll('img').length"), 0);
  EXPECT_EQ(browser.run("return typeof window.broken"), "undefined");
  EXPECT_EQ(browser.run("return document.querySelectorAll('script').length"), 2);
  const auto text = browser.run("return document.body.innerText").get<std::string>();
  EXPECT_THAT(text, testing::HasSubstr(evil));
}

TEST_F(Page, FlatEmptyAndFailedVolumesDrawWhatTheyHave) {
  const std::vector<float> point = {1, 2, 3}, line = {0, 0, 0, 1, 1, 1, 2, 2, 2};
  const std::vector<float> square = {0, 0, 1, 4, 0, 1, 4, 4, 1, 0, 4, 1, 2, 2, 1};
  std::vector<std::vector<AnyVolume>> clusters;
  for (const std::vector<float>& points : {point, line, square}) {
    for (const char* method : {"aabb", "dop26", "sphere", "obb", "cylinder", "capsule", "ellipsoid", "hull"})
      clusters.push_back({fitted(method, points)});
  }
  Json report = report_of(clusters);
  report["clusters"].push_back(
      {{"id", 24},
       {"points", 0},
       {"volumes", Json::array({{{"shape", "aabb"}, {"method", "aabb"}, {"empty", true}}})}});
  report["clusters"].push_back(
      {{"id", 25},
       {"points", 9},
       {"volumes", Json::array({{{"shape", "hull"}, {"method", "hull"}, {"failed", "Qhull gave up"}}})}});
  show(report, {{-5, -5, -5, no_label}, {9, 9, 9, no_label}});
  const Json state = browser.run("return pclBv.state");
  EXPECT_EQ(state["error"], "");
  EXPECT_EQ(state["objects"], clusters.size());
  const Picture picture = settled();
  EXPECT_GT(brightest(picture, project({{1, 2, 3}}).front()), 60);
  for (const Vector2d& at : project({{4, 2, 1}, {0, 2, 1}, {2, 0, 1}, {1, 1, 1}}))
    EXPECT_GT(brightest(picture, at), 60);
  // Each can be picked, too: the point is the smallest of what is there.
  const Vector2d at = project({{1, 2, 3}}).front();
  const Json picked =
      browser.run("return pclBv.pick(" + std::to_string(at.x()) + ", " + std::to_string(at.y()) + ")");
  EXPECT_THAT(picked.get<std::string>(), testing::StartsWith("cluster "));
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
  EXPECT_LT(at[3].y(), at[0].y() - 20);
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
