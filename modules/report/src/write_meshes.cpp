// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <stdexcept>

#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/report/meshes.h"
#include "shortest.h"

namespace pcl_bv {
namespace {

/// Text inside the quotes of an XML attribute.
std::string attribute(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if ((c >= 0 && c < ' ') || c == 0x7F) {
      throw std::invalid_argument("file name " + in_quotes(text) + ": must not hold control characters");
    }
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace

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

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const PvdEntry& entry : entries) {
    text += "    <DataSet timestep=\"" + shortest(entry.time_seconds) + "\" part=\"0\" file=\"" +
            attribute(entry.file) + "\"/>\n";
  }
  write_file_atomically(path, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace pcl_bv
