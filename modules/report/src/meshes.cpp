// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/meshes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "palette.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/read_cloud.h"
#include "volume_cells.h"

namespace pcl_bv {
using namespace detail;
namespace {

std::size_t method_number(const std::string& method, std::vector<std::string>& methods) {
  const auto found = std::find(methods.begin(), methods.end(), method);
  if (found != methods.end()) return static_cast<std::size_t>(found - methods.begin());
  methods.push_back(method);
  return methods.size() - 1;
}

void add_mesh(const Mesh& mesh, std::size_t owner, VolumeCells& cells) {
  if (cells.vertices.size() + mesh.vertices.size() > std::numeric_limits<std::int32_t>::max()) {
    throw std::length_error("more than 2147483647 vertices: too many for a mesh");
  }
  const auto first = static_cast<std::int32_t>(cells.vertices.size());
  cells.vertices.insert(cells.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  cells.vertex_owners.resize(cells.vertices.size(), owner);
  for (const std::vector<std::int32_t>& face : mesh.faces) {
    Cell cell{face, owner};
    for (std::int32_t& vertex : cell.vertices)
      vertex += first;
    auto& kind = face.size() > 2 ? cells.polygons : face.size() == 2 ? cells.lines : cells.points;
    kind.push_back(std::move(cell));
  }
  if (!mesh.faces.empty()) return;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    cells.points.push_back({{first + static_cast<std::int32_t>(i)}, owner});
}

static_assert(std::endian::native == std::endian::little, "values are written as they are in memory");

template <typename T>
void append(T value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Returns whether the vertex count of every face fits in a byte, which is the usual type of this count in
/// .ply files. Faces of flat hulls can have more than 255 vertices.
bool face_counts_fit_byte(const VolumeCells& cells) {
  return std::all_of(cells.polygons.begin(), cells.polygons.end(),
                     [](const Cell& face) { return face.vertices.size() <= 255; });
}

std::string header(const VolumeCells& cells) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment bounding volumes by pcl_bv\n";
  for (std::size_t i = 0; i < cells.methods.size(); ++i)
    text += "comment method " + std::to_string(i) + " is " + cells.methods[i] + "\n";
  text += "element vertex " + std::to_string(cells.vertices.size()) +
          "\nproperty double x\nproperty double y\nproperty double z\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\n"
          "element face " +
          std::to_string(cells.polygons.size()) + "\nproperty list " +
          (face_counts_fit_byte(cells) ? "uchar" : "int") +
          " int vertex_indices\nproperty int cluster\nproperty int method\n";
  if (!cells.lines.empty()) {
    text += "element edge " + std::to_string(cells.lines.size()) +
            "\nproperty int vertex1\nproperty int vertex2\n";
  }
  return text + "end_header\n";
}

void append_vertex(const Eigen::Vector3d& vertex, const Colour& colour, std::string& bytes) {
  if (!vertex.allFinite()) throw std::domain_error("a mesh has a vertex that is not finite");
  for (const double coordinate : vertex)
    append(coordinate, bytes);
  for (const float channel : colour)
    append(static_cast<std::uint8_t>(std::lround(channel * 255)), bytes);
}

void append_face(const Cell& face, bool count_is_a_byte, const CellOwner& owner, std::string& bytes) {
  const auto count = static_cast<std::int32_t>(face.vertices.size());
  if (count_is_a_byte) {
    append(static_cast<std::uint8_t>(count), bytes);
  } else {
    append(count, bytes);
  }
  for (const std::int32_t vertex : face.vertices)
    append(vertex, bytes);
  append(static_cast<std::int32_t>(owner.cluster), bytes);
  append(static_cast<std::int32_t>(owner.method), bytes);
}

}  // namespace

VolumeCells detail::volume_cells(const std::vector<ClusterEntry>& clusters) {
  VolumeCells cells;
  for (std::size_t number = 0; number < clusters.size(); ++number) {
    const ClusterEntry& cluster = clusters[number];
    for (const VolumeEntry& entry : cluster.volumes) {
      const std::size_t method = method_number(entry.method, cells.methods);
      if (empty(entry.volume)) continue;
      cells.owners.push_back({cluster.id, method, cluster.points, volume(entry.volume), number});
      add_mesh(mesh(entry.volume), cells.owners.size() - 1, cells);
    }
  }
  return cells;
}

std::string volumes_ply(const std::vector<ClusterEntry>& clusters) {
  return cells_ply(volume_cells(clusters), clusters.size() > 1);
}

std::string detail::cells_ply(const VolumeCells& cells, bool colour_by_cluster) {
  std::string bytes = header(cells);
  for (std::size_t i = 0; i < cells.vertices.size(); ++i) {
    const CellOwner& owner = cells.owners[cells.vertex_owners[i]];
    const std::size_t colour = colour_by_cluster ? owner.cluster : owner.method;
    append_vertex(cells.vertices[i], palette(static_cast<std::uint32_t>(colour)), bytes);
  }
  const bool count_is_a_byte = face_counts_fit_byte(cells);
  for (const Cell& face : cells.polygons)
    append_face(face, count_is_a_byte, cells.owners[face.owner], bytes);
  for (const Cell& edge : cells.lines) {
    for (const std::int32_t vertex : edge.vertices)
      append(vertex, bytes);
  }
  return bytes;
}

std::optional<MeshFormat> mesh_format(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".vtp") return MeshFormat::vtp;
  if (extension == ".glb") return MeshFormat::glb;
  return std::nullopt;
}

void write_volumes(const std::filesystem::path& path, const std::vector<ClusterEntry>& clusters,
                   MeshFormat format) {
  if (format == MeshFormat::glb) return write_file_atomically(path, volumes_glb(clusters));
  write_file_atomically(path, format == MeshFormat::ply ? volumes_ply(clusters) : volumes_vtp(clusters));
}

}  // namespace pcl_bv
