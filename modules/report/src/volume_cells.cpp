// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "volume_cells.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/report/meshes.h"

namespace pcl_bv {
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

}  // namespace

VolumeCells volume_cells(const std::vector<ClusterEntry>& clusters) {
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

std::optional<MeshFormat> mesh_format(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".vtp") return MeshFormat::vtp;
  return std::nullopt;
}

void write_volumes(const std::filesystem::path& path, const std::vector<ClusterEntry>& clusters,
                   MeshFormat format) {
  write_file_atomically(path, format == MeshFormat::ply ? volumes_ply(clusters) : volumes_vtp(clusters));
}

}  // namespace pcl_bv
