// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// glTF 2.0 in one binary file. Positions are floats, so they are relative to an origin near the volumes,
// which the matrix of the root node adds again in double precision.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "json_text.h"
#include "palette.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/report/meshes.h"
#include "pcl_bv/segmentation/up.h"
#include "pcl_bv/volumes/shortest_rotation.h"
#include "volume_cells.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr int kGlbFloats = 5126, kGlbIndices = 5125, kGlbBytes = 5121;  // component types of glTF
constexpr int kGlbPoints = 0, kGlbLines = 1, kGlbTriangles = 4;         // modes of primitives

// The numbers of a file, and the JSON of the accessors and buffer views that find them.
class GlbNumbers {
 public:
  GlbNumbers() { accessors_.begin('['), views_.begin('['); }

  /// Adds positions relative to the origin. Returns the number of the accessor.
  std::size_t add_positions(const std::vector<Eigen::Vector3f>& positions) {
    Eigen::Vector3f low = positions.front(), high = low;
    for (const Eigen::Vector3f& p : positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    begin_accessor(positions.data(), positions.size() * sizeof positions[0], 34962, kGlbFloats,
                   positions.size(), "VEC3");
    accessors_.add("min", low.cast<double>()).add("max", high.cast<double>()).end('}');
    return accessor_count_++;
  }

  std::size_t add_indices(const std::vector<std::uint32_t>& indices) {
    begin_accessor(indices.data(), indices.size() * 4, 34963, kGlbIndices, indices.size(), "SCALAR");
    accessors_.end('}');
    return accessor_count_++;
  }

  /// Adds colours of vertices: red, green, blue and a byte without meaning, which keeps them aligned.
  std::size_t add_colours(const std::string& bytes) {
    begin_accessor(bytes.data(), bytes.size(), 34962, kGlbBytes, bytes.size() / 4, "VEC4");
    accessors_.add("normalized", true).end('}');
    return accessor_count_++;
  }

  void add_to(JsonText& json) {
    if (binary.empty()) return;
    json.key("accessors").raw(accessors_text_ + ']').key("bufferViews").raw(views_text_ + ']');
    json.key("buffers").begin('[').begin('{').add("byteLength", binary.size()).end('}').end(']');
  }

  std::string binary;

 private:
  void begin_accessor(const void* data, std::size_t bytes, int target, int type, std::size_t count,
                      const char* shape) {
    views_.begin('{').add("buffer", 0).add("byteOffset", binary.size()).add("byteLength", bytes);
    views_.add("target", target).end('}');
    binary.append(static_cast<const char*>(data), bytes);
    accessors_.begin('{').add("bufferView", accessor_count_).add("componentType", type).add("count", count);
    accessors_.add("type", shape);
  }

  std::string accessors_text_, views_text_;
  JsonText accessors_{accessors_text_}, views_{views_text_};
  std::size_t accessor_count_ = 0;
};

float linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

// Materials: one for each colour of the palette, through which points and other volumes are visible.
void add_materials(JsonText& json) {
  json.key("materials").begin('[');
  for (const Colour& colour : palette_colours) {
    json.begin('{').add("doubleSided", true).add("alphaMode", "BLEND").key("pbrMetallicRoughness").begin('{');
    json.key("baseColorFactor").begin('[');
    for (const float channel : colour)
      json.value(static_cast<double>(linear(channel)));
    json.value(0.4);
    json.end(']').add("metallicFactor", 0).end('}').end('}');
  }
  json.end(']');
}

// The cells of a volume, with vertices numbered from 0.
struct GlbVolume {
  std::vector<Eigen::Vector3f> positions;
  std::vector<std::uint32_t> triangles, lines, points;
};

std::vector<GlbVolume> glb_volumes(const VolumeCells& cells, const Eigen::Vector3d& origin) {
  std::vector<GlbVolume> volumes(cells.owners.size());
  std::vector<std::uint32_t> number(cells.vertices.size());
  for (std::size_t i = 0; i < cells.vertices.size(); ++i) {
    if (!cells.vertices[i].allFinite()) throw std::domain_error("a mesh has a vertex that is not finite");
    std::vector<Eigen::Vector3f>& positions = volumes[cells.vertex_owners[i]].positions;
    number[i] = static_cast<std::uint32_t>(positions.size());
    positions.emplace_back((cells.vertices[i] - origin).cast<float>());
    if (!positions.back().allFinite())
      throw std::domain_error("a coordinate is too large for the 32-bit floats of glTF");
  }
  const auto vertex = [&](const Cell& cell, std::size_t i) {
    return number[static_cast<std::size_t>(cell.vertices[i])];
  };
  for (const Cell& face : cells.polygons) {  // polygons are convex
    for (std::size_t i = 2; i < face.vertices.size(); ++i)
      for (const std::size_t corner : {std::size_t{0}, i - 1, i})
        volumes[face.owner].triangles.push_back(vertex(face, corner));
  }
  for (const Cell& edge : cells.lines)
    volumes[edge.owner].lines.insert(volumes[edge.owner].lines.end(), {vertex(edge, 0), vertex(edge, 1)});
  for (const Cell& point : cells.points)
    volumes[point.owner].points.push_back(vertex(point, 0));
  return volumes;
}

void add_mesh(const GlbVolume& volume, std::size_t material, GlbNumbers& numbers, JsonText& json) {
  const std::size_t positions = numbers.add_positions(volume.positions);
  json.begin('{').key("primitives").begin('[');
  const auto add = [&](const std::vector<std::uint32_t>& indices, int mode) {
    if (indices.empty()) return;
    json.begin('{').key("attributes").begin('{').add("POSITION", positions).end('}');
    json.add("indices", numbers.add_indices(indices)).add("mode", mode).add("material", material).end('}');
  };
  add(volume.triangles, kGlbTriangles);
  add(volume.lines, kGlbLines);
  add(volume.points, kGlbPoints);
  json.end(']').end('}');
}

// At most GlbCloud::max_points points, chosen evenly by index, in the colours of their clusters.
struct GlbShownPoints {
  GlbShownPoints(const GlbCloud& cloud, const Eigen::Vector3d& origin) {
    const std::size_t count = cloud.points.count, wanted = std::min(count, cloud.max_points);
    std::size_t number = 0;
    for (std::size_t chunk = 0; wanted > 0 && chunk < chunk_count(count); ++chunk) {
      const LoadedPoints loaded = load_chunk(cloud.points, chunk);
      const PointView& part = loaded.view();
      for (std::size_t i = 0; i < part.count; ++i, ++number) {
        if ((number + 1) * wanted / count == number * wanted / count) continue;
        const Coordinates at = load_point(part, i);
        const Eigen::Vector3f p = (Eigen::Vector3d(at.x, at.y, at.z) - origin).cast<float>();
        if (!p.allFinite()) continue;
        positions.push_back(p);
        const std::uint32_t label = cloud.labels.empty() ? kLabelNone : cloud.labels[part.index(i)];
        const Colour colour = label < kLabelGround ? palette(label) : Colour{0.5f, 0.5f, 0.5f};
        for (const float channel : colour)
          colours += static_cast<char>(std::lround(linear(channel) * 255));
        colours += '\xFF';
      }
    }
  }

  std::vector<Eigen::Vector3f> positions;
  std::string colours;
};

// Returns the rotation from a unit vector to y. A vector with negative y is rotated to -y first.
Eigen::Matrix3d rotation_to_y(const Eigen::Vector3d& unit) {
  const Eigen::Vector3d upper = unit.y() < 0 ? Eigen::Vector3d(-unit) : unit;
  const Eigen::Quaterniond rotation = shortest_rotation(upper, Eigen::Vector3d::UnitY());
  return (unit.y() < 0 ? Eigen::Quaterniond(0, 1, 0, 0) * rotation : rotation).toRotationMatrix();
}

// Column by column: moves by the origin, then rotates `up` to y, which is up in glTF.
Eigen::Matrix4d glb_matrix(const Eigen::Vector3d& up, const Eigen::Vector3d& origin) {
  const Eigen::Vector3d unit = normalized_up(up);
  Eigen::Matrix3d rotation;
  rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // exact for z up
  if (unit != Eigen::Vector3d::UnitZ()) rotation = rotation_to_y(unit);
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = rotation;
  matrix.topRightCorner<3, 1>() = rotation * origin;
  return matrix;
}

std::string glb_file(std::string json, const std::string& binary) {
  json.append(-json.size() % 4, ' ');
  std::string file = "glTF";
  const auto add = [&](std::size_t value) {
    if (value > 0xFFFFFFFF) throw std::length_error("more than 4 GiB: too much for a .glb file");
    const auto word = static_cast<std::uint32_t>(value);
    file.append(reinterpret_cast<const char*>(&word), 4);
  };
  add(2);
  add(20 + json.size() + (binary.empty() ? 0 : 8 + binary.size()));
  add(json.size());
  file += "JSON" + json;
  if (binary.empty()) return file;
  add(binary.size());
  return file.append("BIN\0", 4) + binary;
}

}  // namespace

std::string volumes_glb(const std::vector<ClusterEntry>& clusters, const GlbCloud& cloud) {
  const VolumeCells cells = volume_cells(clusters);
  Aabb all;
  for (const ClusterEntry& cluster : clusters)
    for (const VolumeEntry& entry : cluster.volumes)
      if (!empty(entry.volume)) all.merge(aabb(entry.volume));
  const Eigen::Vector3d origin =
      all.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(all.center().array().round());
  const std::vector<GlbVolume> volumes = glb_volumes(cells, origin);
  const GlbShownPoints shown(cloud, origin);
  GlbNumbers numbers;
  std::string meshes_text, nodes_text, text;
  JsonText meshes(meshes_text), nodes(nodes_text), json(text);
  meshes.begin('['), nodes.begin('[');
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const CellOwner& owner = cells.owners[i];
    const std::size_t colour = clusters.size() > 1 ? owner.cluster : owner.method;
    add_mesh(volumes[i], colour % std::size(palette_colours), numbers, meshes);
    const std::string& method = cells.methods[owner.method];
    nodes.begin('{').add("mesh", i).add("name", "object " + std::to_string(owner.cluster) + " " + method);
    nodes.key("extras").begin('{').add("id", owner.cluster).add("method", method).add("points", owner.points);
    nodes.add("volume", owner.volume).end('}').end('}');
  }
  std::size_t children = volumes.size();
  if (!shown.positions.empty()) {
    meshes.begin('{').key("primitives").begin('[').begin('{').key("attributes").begin('{');
    meshes.add("POSITION", numbers.add_positions(shown.positions))
        .add("COLOR_0", numbers.add_colours(shown.colours));
    meshes.end('}').add("mode", kGlbPoints).end('}').end(']').end('}');
    nodes.begin('{').add("mesh", children++).add("name", "points").end('}');
  }
  nodes.begin('{').add("name", "pcl_bv").add("matrix", glb_matrix(cloud.up, origin).reshaped());
  if (children > 0) nodes.key("children").begin('[');
  for (std::size_t i = 0; i < children; ++i)
    nodes.value(i);
  if (children > 0) nodes.end(']');
  nodes.end('}').end(']');
  json.begin('{')
      .key("asset")
      .begin('{')
      .add("version", "2.0")
      .add("generator", "pcl_bv")
      .end('}')
      .add("scene", 0);
  json.key("scenes").begin('[').begin('{').add("nodes", std::array{children}).end('}').end(']');
  json.key("nodes").raw(nodes_text);
  if (children > 0) json.key("meshes").raw(meshes_text + ']');
  if (!volumes.empty()) add_materials(json);
  numbers.add_to(json);
  json.end('}');
  return glb_file(std::move(text), numbers.binary);
}

}  // namespace pcl_bv
