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

namespace pcl_bv {
namespace {

constexpr double front_alpha = 0.95, back_alpha = 0.32, face_alpha = 0.07;

struct Edge {
  std::int32_t from, to;
  bool front;  ///< Bounds a face that the viewer sees, or one without area.
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

/// The edges of a mesh without those inside a flat side.
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

/// One dark stroke below the coloured one keeps lines crisp on a crowd of points.
void stroke(cairo_t* cairo, const Colour& colour, bool front) {
  if (front) {
    cairo_set_line_width(cairo, 3.6);
    cairo_set_source_rgba(cairo, 0.03, 0.04, 0.07, 0.55);
    cairo_stroke_preserve(cairo);
  }
  cairo_set_line_width(cairo, front ? 1.6 : 1.0);
  set_colour(cairo, colour, front ? front_alpha : back_alpha);
  cairo_stroke(cairo);
}

void draw_mesh(cairo_t* cairo, const Mesh& mesh, const View& view, const Colour& colour) {
  std::vector<Eigen::Vector3d> at;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    at.push_back(view.project(vertex));
  for (const std::vector<std::int32_t>& face : mesh.faces) {
    if (!(normal(mesh, face).dot(view.toward) > 0)) continue;
    for (const std::int32_t v : face)
      cairo_line_to(cairo, at[v].x(), at[v].y());
    cairo_close_path(cairo);
    set_colour(cairo, colour, face_alpha);
    cairo_fill(cairo);
  }
  const std::vector<Edge> edges = drawn_edges(mesh, view);
  for (const bool front : {false, true}) {
    for (const Edge& edge : edges) {
      if (edge.front != front) continue;
      cairo_move_to(cairo, at[edge.from].x(), at[edge.from].y());
      cairo_line_to(cairo, at[edge.to].x(), at[edge.to].y());
    }
    stroke(cairo, colour, front);
  }
}

/// Half of a great circle around `axis`: the half that the viewer sees, or the other.
void half_circle(cairo_t* cairo, const Sphere& sphere, const View& view, const Eigen::Vector3d& axis,
                 bool front) {
  constexpr int steps = 48;
  const Eigen::Vector3d side = axis.cross(view.toward).normalized();  // on the silhouette
  const Eigen::Vector3d facing = side.cross(axis) * (front ? 1 : -1);
  for (int i = 0; i <= steps; ++i) {
    const double angle = M_PI * i / steps;
    const Eigen::Vector3d p =
        sphere.center() + sphere.radius() * (std::cos(angle) * side + std::sin(angle) * facing);
    const Eigen::Vector3d at = view.project(p);
    cairo_line_to(cairo, at.x(), at.y());
  }
  cairo_new_sub_path(cairo);
}

void draw_sphere(cairo_t* cairo, const Sphere& sphere, const View& view, const Colour& colour) {
  const Eigen::Vector3d at = view.project(sphere.center());
  const double radius = sphere.radius() * view.scale;
  cairo_pattern_t* glass = cairo_pattern_create_radial(at.x(), at.y(), 0, at.x(), at.y(), radius);
  cairo_pattern_add_color_stop_rgba(glass, 0.0, colour[0], colour[1], colour[2], 0.02);
  cairo_pattern_add_color_stop_rgba(glass, 0.7, colour[0], colour[1], colour[2], 0.05);
  cairo_pattern_add_color_stop_rgba(glass, 1.0, colour[0], colour[1], colour[2], 0.16);
  cairo_arc(cairo, at.x(), at.y(), radius, 0, 2 * M_PI);
  cairo_set_source(cairo, glass);
  cairo_fill(cairo);
  cairo_pattern_destroy(glass);
  for (const bool front : {false, true}) {
    for (int k = 0; k < 3; ++k)
      half_circle(cairo, sphere, view, Eigen::Vector3d::Unit(k), front);
    cairo_set_line_width(cairo, 0.9);
    set_colour(cairo, colour, front ? 0.55 : 0.18);
    cairo_stroke(cairo);
  }
  cairo_arc(cairo, at.x(), at.y(), radius, 0, 2 * M_PI);
  stroke(cairo, colour, true);
}

void draw_volume(cairo_t* cairo, const PictureVolume& entry, const View& view) {
  if (const auto* sphere = std::get_if<Sphere>(&entry.volume)) {
    draw_sphere(cairo, *sphere, view, palette(entry.colour));
  } else {
    draw_mesh(cairo, mesh(entry.volume), view, palette(entry.colour));
  }
}

/// Far volumes first, so that near ones cross over them.
void draw_volumes(cairo_t* cairo, const Picture& picture, const View& view) {
  std::vector<std::pair<double, const PictureVolume*>> order;
  for (const PictureVolume& entry : picture.volumes) {
    if (empty(entry.volume)) continue;
    order.emplace_back(view.project(center(entry.volume)).z(), &entry);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  for (const auto& [depth, entry] : order)
    draw_volume(cairo, *entry, view);
}

cairo_status_t append(void* file, const unsigned char* bytes, unsigned int n) {
  static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes), n);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
}

void check_size(const Picture& picture) {
  for (const int side : {picture.width, picture.height}) {
    if (side < 16 || side > 16384) {
      throw std::invalid_argument("picture side " + std::to_string(side) + " is not within 16..16384 pixels");
    }
  }
}

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using Context = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

/// The pixels must outlive the surface.
Surface surface_of(std::vector<std::uint32_t>& pixels, const Picture& picture) {
  return {
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_RGB24,
                                          picture.width, picture.height, picture.width * 4),
      cairo_surface_destroy};
}

/// Draws the volumes, over the points if they are given apart.
void draw(cairo_surface_t* surface, cairo_surface_t* points, const Picture& picture, const View& view) {
  const Context cairo(cairo_create(surface), cairo_destroy);
  if (points) {
    cairo_set_source_surface(cairo.get(), points, 0, 0);
    cairo_paint(cairo.get());
  }
  draw_volumes(cairo.get(), picture, view);
  if (!view.empty) draw_marks(cairo.get(), view);
  require(cairo_status(cairo.get()));
}

}  // namespace

std::string picture_png(const Picture& picture) {
  check_size(picture);
  const View view = fit_view(picture);
  std::vector<std::uint32_t> pixels = draw_points(picture, view);
  const Surface surface = surface_of(pixels, picture);
  draw(surface.get(), nullptr, picture, view);
  cairo_surface_flush(surface.get());
  std::string png;
  require(cairo_surface_write_to_png_stream(surface.get(), append, &png));
  return png;
}

std::string picture_svg(const Picture& picture) {
  check_size(picture);
  const View view = fit_view(picture);
  std::vector<std::uint32_t> pixels = draw_points(picture, view);
  const Surface points = surface_of(pixels, picture);
  std::string svg;
  const Surface surface(cairo_svg_surface_create_for_stream(append, &svg, picture.width, picture.height),
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

}  // namespace pcl_bv
