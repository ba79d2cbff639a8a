// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes volumes as meshes for viewers. CloudCompare and MeshLab read .ply files. ParaView reads .vtp and
// .pvd files. Blender, three.js and most other viewers read .glb files.
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

/// File formats of meshes. ply is the Polygon File Format, vtp is VTK PolyData, glb is binary glTF 2.0.
enum class MeshFormat { ply, vtp, glb };

/// Returns the format of a path's extension (.ply, .vtp or .glb in any case). Returns nullopt for all other
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

/// A cloud for volumes_glb(). By default it has no points.
struct GlbCloud {
  PointView points{};
  std::vector<std::uint32_t> labels{};            ///< Cluster of each point by its index, or empty.
  std::size_t max_points = 200000;                ///< Of more points, so many are chosen evenly by index.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Direction against gravity, of any length except 0.
};

/// Returns the meshes of all volumes, and points of the cloud, as the content of one .glb file. Each volume
/// is a node with a mesh, named "object ID METHOD", with the id, the method, the number of points and the
/// volume as extras. Colours are those of volumes_ply(), 60 % transparent; degenerate volumes have lines or
/// points. The node "points" has the finite points, in the colours of their clusters, without a cluster grey.
///
/// glTF stores positions as floats. They are relative to an origin near the volumes: a position is the float
/// next to the difference. The matrix of the root node adds the origin, and rotates `up` to y, which is up in
/// glTF.
///
/// Throws as volumes_ply(), std::domain_error for a vertex whose difference is beyond the range of float, and
/// std::length_error for more than 4 GiB.
std::string volumes_glb(const std::vector<ClusterEntry>& clusters, const GlbCloud& cloud = {});

/// Returns the valid points as a VTK PolyData file with one cell. The point with the index i
/// (PointView::index()) has the value labels[i] in the array `label`.
std::string points_vtp(const PointView& points, const std::vector<std::uint32_t>& labels);

/// Writes volumes_ply(), volumes_vtp() or volumes_glb() without points to a file through
/// write_file_atomically(). Throws IoError if the file cannot be written.
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
