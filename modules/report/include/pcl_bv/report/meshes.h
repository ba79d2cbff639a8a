// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes volumes as meshes for viewers: .ply for CloudCompare and MeshLab, .vtp and .pvd for ParaView.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/report/report.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// File formats of meshes: PLY, and VTK PolyData.
enum class MeshFormat { ply, vtp };

/// Returns the format of a path's extension (.ply or .vtp in any case); nullopt for all others.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& path);

/// Returns the meshes of all volumes (see mesh() of each shape) as the content of one binary_little_endian
/// .ply file with double coordinates. Vertices have the colour of their cluster or, if there is only one
/// cluster, of their method, as in pictures. Faces have the id of the cluster and the number of the method;
/// comments name the methods. A degenerate volume without faces is written as edges, a single point as a
/// vertex. Empty volumes are left out. Without volumes the file has no vertices.
///
/// Throws std::domain_error if a coordinate is not finite, which does not occur in fitted volumes, and
/// std::length_error for more than 2147483647 vertices.
std::string volumes_ply(const std::vector<ClusterEntry>& clusters);

/// Returns the meshes as a VTK PolyData file (XML, ascii); every number has the digits that read back
/// exactly. Each cell (polygon, line or vertex) has `cluster` (the id), `method` (a number from 0 on, in
/// order of appearance), `points` and `volume`; if `tracked`, also `track` (-1 without a track), `age` and
/// `velocity`. The field data `methods` has the methods' names. Throws as volumes_ply().
std::string volumes_vtp(const std::vector<ClusterEntry>& clusters, bool tracked = false);

/// Returns the valid points as a VTK PolyData file with one cell. Each point has its `label`, which is
/// labels[index of the point].
std::string points_vtp(const PointView& points, const std::vector<std::uint32_t>& labels);

/// Writes volumes_ply() or volumes_vtp() to a file through write_file_atomically(). Throws IoError if that
/// fails.
void write_volumes(const std::filesystem::path& path, const std::vector<ClusterEntry>& clusters,
                   MeshFormat format);

/// One file in a ParaView time series.
struct PvdEntry {
  double time_seconds = 0;
  std::string file;  ///< Path of the file, UTF-8, relative to the folder of the .pvd file.
  int part = 0;      ///< Number of the file among those that are shown at the same time.
};

/// Beginning of a .pvd file, the index of a ParaView time series: kPvdBegin, entries, kPvdEnd.
inline constexpr std::string_view kPvdBegin =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "  <Collection>\n";
/// End of a .pvd file.
inline constexpr std::string_view kPvdEnd = "  </Collection>\n</VTKFile>\n";

/// Returns the line of an entry in a .pvd file. Throws std::invalid_argument for a file name with control
/// characters, which XML cannot represent, and std::domain_error for a time that is not finite.
std::string pvd_entry(const PvdEntry& entry);

}  // namespace pcl_bv
