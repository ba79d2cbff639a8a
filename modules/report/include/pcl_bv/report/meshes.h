// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes as meshes for viewers: .ply for CloudCompare and MeshLab, .vtp and .pvd for ParaView.
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

enum class MeshFormat { ply, vtp };

/// The format that a path's extension names, in any case.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& path);

/// The meshes of all volumes (see mesh() of each) as one binary_little_endian .ply file in memory,
/// coordinates as double. Vertices have the colour of their cluster or, where there is only one cluster, of
/// their method: the same colours as in pictures. Faces have the id of the cluster and the number of the
/// method; comments name the methods. A flat volume without faces is there as edges, a point as a vertex.
/// Empty volumes are left out; of nothing there is a file with no vertices.
///
/// Throws std::domain_error if a coordinate is not finite, which no fitted volume has; std::length_error
/// beyond 2147483647 vertices.
std::string volumes_ply(const std::vector<ClusterEntry>& clusters);

/// The same as a VTK PolyData file (XML, ascii), every number with the digits that read back exactly. Each
/// cell (polygon, line or vertex) has `cluster` (the id), `method` (a number from 0 on, in order of
/// appearance), `points` and `volume`; if they are `tracked`, `track` (-1 for none), `age` and `velocity`,
/// too; the field data `methods` holds the methods' names.
std::string volumes_vtp(const std::vector<ClusterEntry>& clusters, bool tracked = false);

/// The valid points as such a file, in one cell, each with its `label`: labels[number of the point].
std::string points_vtp(const PointView& points, const std::vector<std::uint32_t>& labels);

/// Writes one of the above as write_file_atomically() does. Throws IoError if that fails.
void write_volumes(const std::filesystem::path& path, const std::vector<ClusterEntry>& clusters,
                   MeshFormat format);

/// One frame of a recording.
struct PvdEntry {
  double time_seconds = 0;
  std::string file;  ///< Of the frame, UTF-8, relative to the folder of the index.
  int part = 0;      ///< Of what is shown together at this time.
};

/// The index by which ParaView plays frames as a time series is a file of pvd_begin, entries and pvd_end.
inline constexpr std::string_view pvd_begin =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "  <Collection>\n";
inline constexpr std::string_view pvd_end = "  </Collection>\n</VTKFile>\n";

/// Throws std::invalid_argument for a file name with control characters, which XML cannot hold;
/// std::domain_error for a time that is not finite.
std::string pvd_entry(const PvdEntry& entry);

}  // namespace pcl_bv
