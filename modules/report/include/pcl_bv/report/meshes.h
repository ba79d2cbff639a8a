// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes as meshes for viewers: .ply for CloudCompare and MeshLab, .vtp and .pvd for ParaView.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pcl_bv/io/io_error.h"
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
/// appearance), `points` and `volume`; the field data `methods` holds the methods' names.
std::string volumes_vtp(const std::vector<ClusterEntry>& clusters);

/// Writes one of the above as write_file_atomically() does. Throws IoError if that fails.
void write_volumes(const std::filesystem::path& path, const std::vector<ClusterEntry>& clusters,
                   MeshFormat format);

/// One frame of a recording.
struct PvdEntry {
  double time_seconds = 0;
  std::string file;  ///< Of the frame, UTF-8, relative to the folder of the index.
};

/// Writes the index by which ParaView plays frames as a time series, as write_file_atomically() does. Throws
/// IoError if that fails; std::invalid_argument for a file name with control characters, which XML cannot
/// hold; std::domain_error for a time that is not finite.
void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);

}  // namespace pcl_bv
