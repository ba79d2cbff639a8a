// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where the pixels of points and volumes are, by the library's own geometry and the camera of the page.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "page_scene.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

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
      shape_name(volume) == "hull" || shape_name(volume) == "prism")
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
                                         "prism", "hull"),
                         [](const auto& shape) { return std::string(shape.param); });

TEST_F(Page, CoordinatesOfUtmSizeDrawAsSmallOnesDo) {
  const Vector3d far(500123, 4500321, 512);
  std::vector<std::vector<AnyVolume>> near_clusters, far_clusters;
  for (const char* method :
       {"aabb", "dop26", "sphere", "obb", "cylinder", "capsule", "ellipsoid", "prism", "hull"}) {
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

TEST_F(Page, FlatEmptyAndFailedVolumesDrawWhatTheyHave) {
  const std::vector<float> point = {1, 2, 3}, line = {0, 0, 0, 1, 1, 1, 2, 2, 2};
  const std::vector<float> square = {0, 0, 1, 4, 0, 1, 4, 4, 1, 0, 4, 1, 2, 2, 1};
  std::vector<std::vector<AnyVolume>> clusters;
  for (const std::vector<float>& points : {point, line, square}) {
    for (const char* method :
         {"aabb", "dop26", "sphere", "obb", "cylinder", "capsule", "ellipsoid", "prism", "hull"})
      clusters.push_back({fitted(method, points)});
  }
  Json report = report_of(clusters);
  report["clusters"].push_back(
      {{"id", 27},
       {"points", 0},
       {"volumes", Json::array({{{"shape", "aabb"}, {"method", "aabb"}, {"empty", true}}})}});
  report["clusters"].push_back(
      {{"id", 28},
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

TEST_F(Page, ABayOfAPrismIsNeitherDrawnNorPicked) {
  const Prism prism(Eigen::Matrix3d::Identity(), {{0, 0}, {9, 0}, {9, 2}, {2, 2}, {2, 9}, {0, 9}}, 0, 0.01);
  show(report_of({{prism}}), {{-5, -5, -5, no_label}, {12, 12, 9, no_label}});
  const auto pick = [&](const Vector2d& at) {
    const Json picked =
        browser.run("return pclBv.pick(" + std::to_string(at.x()) + ", " + std::to_string(at.y()) + ")");
    return picked.is_string() ? picked.get<std::string>() : std::string();
  };
  const Picture picture = settled();
  for (const Vector2d& at : project({{1, 1, 0}, {7, 1, 0}, {1, 7, 0}})) {
    EXPECT_GT(brightest(picture, at), 5);
    EXPECT_THAT(pick(at), testing::StartsWith("cluster "));
  }
  for (const Vector2d& at : project({{4.5, 4.5, 0}, {6, 4, 0}})) {
    EXPECT_EQ(brightest(picture, at), 0);
    EXPECT_THAT(pick(at), testing::Not(testing::StartsWith("cluster ")));
  }
}

TEST_F(Page, FlatPolytopesDrawTheirOutline) {
  const std::vector<float> square = {0, 0, 1, 4, 0, 1, 4, 4, 1, 0, 4, 1, 2, 2, 1};
  for (const char* method : {"aabb", "dop26", "obb", "prism", "hull"}) {
    show(report_of({{fitted(method, square)}}), {{-5, -5, -5, no_label}, {9, 9, 9, no_label}});
    const Picture picture = settled();
    for (const Vector2d& at : project({{4, 2, 1}, {0, 2, 1}, {2, 0, 1}, {2, 4, 1}}))
      EXPECT_GT(brightest(picture, at), 100) << method;
    EXPECT_GT(brightest(picture, project({{1, 2, 1}}).front()), 5) << method << " has a face";
  }
}

}  // namespace
}  // namespace pcl_bv::test
