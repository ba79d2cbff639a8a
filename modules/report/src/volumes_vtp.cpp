// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <stdexcept>

#include "formatting.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/report/meshes.h"
#include "volume_cells.h"

namespace pcl_bv {
using namespace detail;
namespace {

using Cells = std::vector<Cell>;

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + value + "\"";
}

std::string attribute(const std::string& name, std::size_t value) {
  return attribute(name, std::to_string(value));
}

/// Returns a <DataArray> element. append(text) appends the numbers of the array.
template <typename Append>
std::string data_array(const std::string& type, const std::string& name, const Append& append,
                       const std::string& more_attributes = "") {
  std::string text = "        <DataArray" + attribute("type", type) + attribute("Name", name) +
                     more_attributes + " format=\"ascii\">\n";
  append(text);
  return text + "\n        </DataArray>\n";
}

std::string cells_element(const std::string& name, const Cells& cells) {
  const auto connectivity = [&](std::string& text) {
    for (const Cell& cell : cells) {
      for (const std::int32_t vertex : cell.vertices)
        text += std::to_string(vertex) + ' ';
    }
  };
  const auto offsets = [&](std::string& text) {
    std::size_t end = 0;
    for (const Cell& cell : cells)
      text += std::to_string(end += cell.vertices.size()) + ' ';
  };
  return "      <" + name + ">\n" + data_array("Int64", "connectivity", connectivity) +
         data_array("Int64", "offsets", offsets) + "      </" + name + ">\n";
}

std::string coordinates(const Eigen::Vector3d& p) {
  return shortest(p.x()) + ' ' + shortest(p.y()) + ' ' + shortest(p.z());
}

std::string cell_data(const VolumeCells& cells, const std::vector<ClusterEntry>& clusters, bool tracked) {
  const auto column = [&](const char* type, const char* name, const auto& value_of,
                          const std::string& more_attributes = "") {
    const auto append = [&](std::string& text) {
      // VTK numbers the cells in the order points, lines, polygons.
      for (const Cells* kind : {&cells.points, &cells.lines, &cells.polygons}) {
        for (const Cell& cell : *kind)
          text += value_of(cells.owners[cell.owner]) + ' ';
      }
    };
    return data_array(type, name, append, more_attributes);
  };
  const auto track = [&](auto& owner) { return clusters[owner.entry].track.value_or(TrackEntry()); };
  const auto id = [&](auto& owner) {
    return clusters[owner.entry].track ? std::to_string(track(owner).id) : "-1";
  };
  const auto age = [&](auto& owner) { return std::to_string(track(owner).age); };
  const auto velocity = [&](auto& owner) { return coordinates(track(owner).velocity); };
  return "      <CellData Scalars=\"cluster\">\n" +
         column("Int64", "cluster", [](auto& owner) { return std::to_string(owner.cluster); }) +
         column("Int64", "method", [](auto& owner) { return std::to_string(owner.method); }) +
         column("Int64", "points", [](auto& owner) { return std::to_string(owner.points); }) +
         column("Float64", "volume", [](auto& owner) { return shortest(owner.volume); }) +
         (tracked ? column("Int64", "track", id) + column("Int64", "age", age) +
                        column("Float64", "velocity", velocity, attribute("NumberOfComponents", 3))
                  : "") +
         "      </CellData>\n";
}

std::string points_element(const std::vector<Eigen::Vector3d>& vertices) {
  const auto all = [&](std::string& text) {
    for (const Eigen::Vector3d& vertex : vertices)
      text += coordinates(vertex) + '\n';
  };
  return "      <Points>\n" + data_array("Float64", "Points", all, attribute("NumberOfComponents", 3)) +
         "      </Points>\n";
}

/// Returns the methods' names as field data. In VTK, a string is the codes of its characters, then 0.
std::string method_names(const VolumeCells& cells) {
  const auto characters = [&](std::string& text) {
    for (const std::string& method : cells.methods) {
      for (const char c : method)
        text += std::to_string(static_cast<unsigned char>(c)) + ' ';
      text += "0 ";
    }
  };
  return "    <FieldData>\n" +
         data_array("String", "methods", characters, attribute("NumberOfTuples", cells.methods.size())) +
         "    </FieldData>\n";
}

/// Returns the text as the value of a quoted XML attribute, with special characters escaped. Throws
/// std::invalid_argument for control characters.
std::string escape(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if ((c >= 0 && c < ' ') || c == 0x7F) {
      throw std::invalid_argument("file name " + in_quotes(text) + ": must not hold control characters");
    }
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return escaped;
}

/// Returns the content of a VTK file with one piece.
std::string polydata(const std::string& fields, const std::string& counts, const std::string& content) {
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
         "  <PolyData>\n" +
         fields + "    <Piece" + counts + ">\n" + content + "    </Piece>\n  </PolyData>\n</VTKFile>\n";
}

std::string counts(std::size_t points, std::size_t verts, std::size_t lines, std::size_t polys) {
  return attribute("NumberOfPoints", points) + attribute("NumberOfVerts", verts) +
         attribute("NumberOfLines", lines) + attribute("NumberOfStrips", 0) +
         attribute("NumberOfPolys", polys);
}

}  // namespace

std::string volumes_vtp(const std::vector<ClusterEntry>& clusters, bool tracked) {
  const VolumeCells cells = volume_cells(clusters);
  return polydata(
      method_names(cells),
      counts(cells.vertices.size(), cells.points.size(), cells.lines.size(), cells.polygons.size()),
      cell_data(cells, clusters, tracked) + points_element(cells.vertices) +
          cells_element("Verts", cells.points) + cells_element("Lines", cells.lines) +
          cells_element("Polys", cells.polygons));
}

std::string points_vtp(const PointView& points, const std::vector<std::uint32_t>& labels) {
  std::vector<Eigen::Vector3d> valid;
  Cell cell;
  std::string numbers;
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
    const LoadedPoints loaded = load_chunk(points, chunk);
    const PointView& part = loaded.view();
    for (std::size_t i = 0; i < part.count; ++i) {
      const Coordinates p = load_point(part, i);
      if (!is_valid(p)) continue;
      cell.vertices.push_back(static_cast<std::int32_t>(valid.size()));
      valid.emplace_back(p.x, p.y, p.z);
      numbers += std::to_string(labels[part.index(i)]) + ' ';
    }
  }
  const Cells cells(valid.empty() ? 0 : 1, cell);
  return polydata("", counts(valid.size(), cells.size(), 0, 0),
                  "      <PointData Scalars=\"label\">\n" +
                      data_array("UInt32", "label", [&](std::string& text) { text += numbers; }) +
                      "      </PointData>\n" + points_element(valid) + cells_element("Verts", cells));
}

std::string pvd_entry(const PvdEntry& entry) {
  return "    <DataSet" + attribute("timestep", shortest(entry.time_seconds)) +
         attribute("part", std::to_string(entry.part)) + attribute("file", escape(entry.file)) + "/>\n";
}

}  // namespace pcl_bv
