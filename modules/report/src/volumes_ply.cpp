// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "palette.h"
#include "pcl_bv/report/meshes.h"
#include "volume_cells.h"

namespace pcl_bv {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they are in memory");

template <typename T>
void append(T value, std::string& bytes) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// The count of a face's corners is a byte, as everywhere, unless a flat hull has more of them.
bool counts_fit_a_byte(const VolumeCells& cells) {
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
          (counts_fit_a_byte(cells) ? "uchar" : "int") +
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

std::string volumes_ply(const std::vector<ClusterEntry>& clusters) {
  return cells_ply(volume_cells(clusters), clusters.size() > 1);
}

std::string cells_ply(const VolumeCells& cells, bool colour_by_cluster) {
  std::string bytes = header(cells);
  for (std::size_t i = 0; i < cells.vertices.size(); ++i) {
    const CellOwner& owner = cells.owners[cells.vertex_owners[i]];
    const std::size_t colour = colour_by_cluster ? owner.cluster : owner.method;
    append_vertex(cells.vertices[i], palette(static_cast<std::uint32_t>(colour)), bytes);
  }
  const bool count_is_a_byte = counts_fit_a_byte(cells);
  for (const Cell& face : cells.polygons)
    append_face(face, count_is_a_byte, cells.owners[face.owner], bytes);
  for (const Cell& edge : cells.lines) {
    for (const std::int32_t vertex : edge.vertices)
      append(vertex, bytes);
  }
  return bytes;
}

}  // namespace pcl_bv
