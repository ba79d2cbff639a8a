// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Pages with one cloud inside, and what a browser has drawn of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "browser.h"
#include "page.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/report/report.h"
#include "temporary_folder.h"

namespace pcl_bv::test {
using namespace detail;

using Eigen::Vector2d, Eigen::Vector3d;
using Json = nlohmann::json;

inline constexpr std::uint32_t no_label = 4294967295;

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
  std::string url() const { return "file://" + path_.string(); }

 private:
  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "page.html";
};

inline Json report_of(const std::vector<std::vector<AnyVolume>>& clusters) {
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

inline AnyVolume fitted(std::string_view method, const std::vector<float>& xyz) {
  AnyVolume volume =
      *find_method(method)->fit(PointView::of(xyz.data(), 12, xyz.size() / 3), {}, Execution());
  return volume;
}

// Points that no shape fits well, longer than wide and askew.
inline std::vector<float> lump(const Vector3d& at, unsigned seed) {
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
inline int above_ground(const std::uint8_t* rgba) {
  return std::max({std::abs(rgba[0] - 14), std::abs(rgba[1] - 17), std::abs(rgba[2] - 22)});
}

// The scene without the bar above it, the axes and the scale.
inline bool in_scene(int x, int y) {
  return y > 45 && y < 530 && x > 2 && x < 797;
}

// The brightest within a pixel of there.
inline int brightest(const Picture& picture, const Vector2d& at) {
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

}  // namespace pcl_bv::test
