// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/picture.h"

#include <cairo-svg.h>
#include <cairo.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/read_cloud.h"
#include "picture_parts.h"

namespace pcl_bv::detail {
namespace {

constexpr double face_alpha = 0.07;

struct Edge {
  std::int32_t from, to;
  bool front;  ///< Whether the edge belongs to a face that the viewer sees, or to a face without area.
};

void set_colour(cairo_t* cairo, const Colour& colour, double alpha) {
  cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2], alpha);
}

Eigen::Vector3d normal(const Mesh& mesh, const std::vector<std::int32_t>& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = mesh.vertices[face[0]];
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    sum += (mesh.vertices[face[i]] - origin).cross(mesh.vertices[face[i + 1]] - origin);
  }
  return sum.stableNormalized();
}

/// Returns the edges of a mesh, except the edges between two coplanar faces.
std::vector<Edge> drawn_edges(const Mesh& mesh, const View& view) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<Eigen::Vector3d>> normals_at;
  for (const std::vector<std::int32_t>& face : mesh.faces) {
    const Eigen::Vector3d n = normal(mesh, face);
    for (std::size_t i = 0; i < face.size(); ++i) {
      normals_at[std::minmax(face[i], face[(i + 1) % face.size()])].push_back(n);
    }
  }
  std::vector<Edge> edges;
  for (const auto& [ends, normals] : normals_at) {
    const bool flat = normals.size() == 2 && normals[0].dot(normals[1]) > 1 - 1e-9;
    const bool front = std::any_of(normals.begin(), normals.end(), [&](const Eigen::Vector3d& n) {
      return n.isZero(0) || n.dot(view.toward) > 0;
    });
    if (!flat) edges.push_back({ends.first, ends.second, front});
  }
  return edges;
}

void draw_mesh(cairo_t* cairo, const Mesh& mesh, const View& view, const Colour& colour, std::uint32_t dash) {
  std::vector<Eigen::Vector3d> corners;
  for (const std::vector<std::int32_t>& face : mesh.faces) {
    if (!(normal(mesh, face).dot(view.toward) > 0)) continue;
    corners.clear();
    for (const std::int32_t v : face)
      corners.push_back(mesh.vertices[v]);
    add_path(cairo, view, corners, true);
    set_colour(cairo, colour, face_alpha);
    cairo_fill(cairo);
  }
  const std::vector<Edge> edges = drawn_edges(mesh, view);
  for (const bool front : {false, true}) {
    for (const Edge& edge : edges) {
      if (edge.front == front)
        add_path(cairo, view, {mesh.vertices[edge.from], mesh.vertices[edge.to]}, false);
    }
    stroke(cairo, colour, front, dash);
  }
}

/// Adds an arc on a sphere, from the unit vector `from` by `angle` towards `to`. The steps are small enough
/// to look smooth. A full circle is closed.
void add_arc(cairo_t* cairo, const Sphere& sphere, const View& view, const Eigen::Vector3d& from,
             const Eigen::Vector3d& to, double angle) {
  const double fine = 1.6 * angle * std::sqrt(sphere.radius() * view.scale);
  const int steps = static_cast<int>(std::max(24.0, std::min(1e5, fine)));
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= steps; ++i) {
    const double at = angle * i / steps;
    points.emplace_back(sphere.center() + sphere.radius() * (std::cos(at) * from + std::sin(at) * to));
  }
  add_path(cairo, view, points, angle > M_PI);
}

/// Fills the path so that it looks like a glass ball. A ball that is too large for Cairo's gradients is not
/// filled.
void fill_glass(cairo_t* cairo, const Eigen::Vector3d& at, double radius, const Colour& colour) {
  constexpr double widest = 1e5;
  const bool fits = std::abs(at.x()) < widest && std::abs(at.y()) < widest && radius < widest;  // not for NaN
  if (!fits) return cairo_new_path(cairo);
  cairo_pattern_t* glass = cairo_pattern_create_radial(at.x(), at.y(), 0, at.x(), at.y(), radius);
  for (const auto& [part, alpha] : {std::pair{0.0, 0.02}, {0.7, 0.05}, {1.0, 0.16}})
    cairo_pattern_add_color_stop_rgba(glass, part, colour[0], colour[1], colour[2], alpha);
  cairo_set_source(cairo, glass);
  cairo_fill(cairo);
  cairo_pattern_destroy(glass);
}

void draw_sphere(cairo_t* cairo, const Sphere& sphere, const View& view, const Colour& colour,
                 std::uint32_t dash) {
  add_arc(cairo, sphere, view, view.right, view.up, 2 * M_PI);
  fill_glass(cairo, view.project(sphere.center()), sphere.radius() * view.scale, colour);
  for (const bool front : {false, true}) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k), side = axis.cross(view.toward);
      if (side.norm() < 1e-6) continue;  // this circle is the outline
      const Eigen::Vector3d along = side.normalized();
      add_arc(cairo, sphere, view, along, along.cross(axis) * (front ? 1 : -1), M_PI);
    }
    cairo_set_line_width(cairo, 0.9);
    set_colour(cairo, colour, front ? 0.55 : 0.18);
    cairo_stroke(cairo);
  }
  add_arc(cairo, sphere, view, view.right, view.up, 2 * M_PI);
  stroke(cairo, colour, true, dash);
}

/// Draws the volumes. Far volumes are drawn first, so that near volumes are on top.
void draw_volumes(cairo_t* cairo, const Picture& picture, const View& view, const Styles& styles) {
  std::vector<std::pair<double, const PictureVolume*>> order;
  for (const PictureVolume& entry : picture.volumes) {
    if (empty(entry.volume)) continue;
    order.emplace_back(view.project(center(entry.volume)).z(), &entry);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  for (const auto& [depth, entry] : order) {
    const Colour colour = palette(entry->colour);
    const std::uint32_t dash = styles.dash(entry->method);
    if (const auto* sphere = std::get_if<Sphere>(&entry->volume)) {
      draw_sphere(cairo, *sphere, view, colour, dash);
    } else {
      draw_mesh(cairo, mesh(entry->volume), view, colour, dash);
    }
  }
}

cairo_status_t append(void* file, const unsigned char* bytes, unsigned int n) {
  static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes), n);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
}

void check(const Picture& picture) {
  for (const int side : {picture.width, picture.height}) {
    if (side < 16 || side > 16384) {
      throw std::invalid_argument("picture width or height " + std::to_string(side) +
                                  " is not within 16..16384 pixels");
    }
  }
  const Eigen::Vector3d& up = picture.up;
  if (!up.allFinite() || up.isZero(0)) {
    throw std::invalid_argument("picture up " + std::to_string(up.x()) + " " + std::to_string(up.y()) + " " +
                                std::to_string(up.z()) + " is zero or not finite");
  }
}

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using Context = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

/// Returns a Cairo surface that uses the pixels. The pixels must outlive the surface.
Surface surface_of(std::vector<std::uint32_t>& pixels, const View& view) {
  return {cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                              CAIRO_FORMAT_RGB24, view.width, view.height, view.width * 4),
          cairo_surface_destroy};
}

/// Draws the volumes and marks. If `points` is not null, draws the points first.
void draw(cairo_surface_t* surface, cairo_surface_t* points, const Picture& picture, const View& view) {
  const Context cairo(cairo_create(surface), cairo_destroy);
  if (points) {
    cairo_set_source_surface(cairo.get(), points, 0, 0);
    cairo_paint(cairo.get());
  }
  const Styles styles(picture);
  draw_volumes(cairo.get(), picture, view, styles);
  if (!view.empty && has_marks(view)) draw_marks(cairo.get(), picture, view, styles);
  require(cairo_status(cairo.get()));
}

}  // namespace

std::string picture_png(const Picture& picture) {
  check(picture);
  const View view = fit_view(picture);
  std::vector<std::uint32_t> pixels = draw_points(picture, view);
  const Surface surface = surface_of(pixels, view);
  draw(surface.get(), nullptr, picture, view);
  cairo_surface_flush(surface.get());
  std::string png;
  require(cairo_surface_write_to_png_stream(surface.get(), append, &png));
  return png;
}

std::string picture_svg(const Picture& picture) {
  check(picture);
  const View view = fit_view(picture);
  std::vector<std::uint32_t> pixels = draw_points(picture, view);
  const Surface points = surface_of(pixels, view);
  std::string svg;
  const Surface surface(cairo_svg_surface_create_for_stream(append, &svg, view.width, view.height),
                        cairo_surface_destroy);
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  draw(surface.get(), points.get(), picture, view);
  cairo_surface_finish(surface.get());
  require(cairo_surface_status(surface.get()));
  return svg;
}

void write_picture(const std::filesystem::path& path, const Picture& picture) {
  const bool svg = lower_case_extension(path) == ".svg";
  write_file_atomically(path, svg ? picture_svg(picture) : picture_png(picture));
}

}  // namespace pcl_bv::detail
