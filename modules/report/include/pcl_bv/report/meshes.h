// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes volumes as meshes for viewers. CloudCompare and MeshLab read .ply files. ParaView reads .vtp and
// .pvd files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/report/report.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// File formats of meshes. ply is the Polygon File Format, vtp is VTK PolyData.
enum class MeshFormat { ply, vtp };

/// Returns the format of a path's extension (.ply or .vtp in any case). Returns nullopt for all other
/// extensions.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& path);

/// Returns the meshes of all volumes (see mesh() of each shape) as the content of one binary_little_endian
/// .ply file with double coordinates. Vertices have the colour of their cluster. If there is only one
/// cluster, they have the colour of their method, as in pictures. Faces have the id of the cluster and the
/// number of the method. Comments of the file name the methods. A degenerate volume without faces is written
/// as edges, and a single point as a vertex. Empty volumes are left out. A file without volumes has no
/// vertices.
///
/// Throws std::length_error for more than 2147483647 vertices. Throws std::domain_error if a coordinate is
/// not finite, which does not occur in fitted volumes.
std::string volumes_ply(const std::vector<ClusterEntry>& clusters);

/// Returns the meshes as a VTK PolyData file (XML, ascii). Every number has the fewest digits that read back
/// as exactly the same double. Each cell (polygon, line or vertex) has these values:
/// - `cluster`: the id of the cluster;
/// - `method`: the number of the method, counted from 0 in order of appearance;
/// - `points`: the number of points of the cluster;
/// - `volume`: the volume of the shape;
/// - if `tracked`, also `track` (the id of the track, -1 without a track), `age` and `velocity`.
///
/// The field data `methods` has the names of the methods. Throws as volumes_ply().
std::string volumes_vtp(const std::vector<ClusterEntry>& clusters, bool tracked = false);

/// Returns the valid points as a VTK PolyData file with one cell. The point with the index i
/// (PointView::index()) has the value labels[i] in the array `label`.
std::string points_vtp(const PointView& points, const std::vector<std::uint32_t>& labels);

/// Writes volumes_ply() or volumes_vtp() to a file through write_file_atomically(). Throws IoError if the
/// file cannot be written.
void write_volumes(const std::filesystem::path& path, const std::vector<ClusterEntry>& clusters,
                   MeshFormat format);

/// One file in a ParaView time series.
struct PvdEntry {
  double time_seconds = 0;
  std::string file;  ///< Path of the file, UTF-8, relative to the folder of the .pvd file.
  int part = 0;      ///< Number of the file among the files that are shown at the same time.
};

/// Beginning of a .pvd file, which is the index of a ParaView time series. The file is kPvdBegin, all
/// entries, and kPvdEnd.
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
