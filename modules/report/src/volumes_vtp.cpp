// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <string_view>

#include "pcl_bv/report/meshes.h"
#include "shortest.h"
#include "volume_cells.h"

namespace pcl_bv {
namespace {

using Cells = std::vector<Cell>;

/// One <DataArray>, for whose numbers `append` is called with the text.
template <typename Append>
std::string data_array(const std::string& attributes, const Append& append) {
  std::string text = "        <DataArray " + attributes + " format=\"ascii\">\n";
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
  return "      <" + name + ">\n" + data_array("type=\"Int64\" Name=\"connectivity\"", connectivity) +
         data_array("type=\"Int64\" Name=\"offsets\"", offsets) + "      </" + name + ">\n";
}

std::string cell_data(const VolumeCells& cells) {
  const auto column = [&](const std::string& attributes, const auto& value_of) {
    return data_array(attributes, [&](std::string& text) {
      // VTK counts cells in this order.
      for (const Cells* kind : {&cells.points, &cells.lines, &cells.polygons}) {
        for (const Cell& cell : *kind)
          text += value_of(cells.owners[cell.owner]) + ' ';
      }
    });
  };
  return "      <CellData Scalars=\"cluster\">\n" +
         column("type=\"Int64\" Name=\"cluster\"",
                [](auto& owner) { return std::to_string(owner.cluster); }) +
         column("type=\"Int64\" Name=\"method\"", [](auto& owner) { return std::to_string(owner.method); }) +
         column("type=\"Int64\" Name=\"points\"", [](auto& owner) { return std::to_string(owner.points); }) +
         column("type=\"Float64\" Name=\"volume\"", [](auto& owner) { return shortest(owner.volume); }) +
         "      </CellData>\n";
}

std::string points_element(const VolumeCells& cells) {
  const auto coordinates = [&](std::string& text) {
    for (const Eigen::Vector3d& vertex : cells.vertices)
      text += shortest(vertex.x()) + ' ' + shortest(vertex.y()) + ' ' + shortest(vertex.z()) + '\n';
  };
  return "      <Points>\n" +
         data_array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", coordinates) +
         "      </Points>\n";
}

/// Strings are written as the numbers of their characters, each ended by 0.
std::string method_names(const VolumeCells& cells) {
  const auto characters = [&](std::string& text) {
    for (const std::string& method : cells.methods) {
      for (const char c : method)
        text += std::to_string(static_cast<unsigned char>(c)) + ' ';
      text += "0 ";
    }
  };
  return "    <FieldData>\n" +
         data_array("type=\"String\" Name=\"methods\" NumberOfTuples=\"" +
                        std::to_string(cells.methods.size()) + "\"",
                    characters) +
         "    </FieldData>\n";
}

}  // namespace

std::string volumes_vtp(const std::vector<ClusterEntry>& clusters) {
  const VolumeCells cells = volume_cells(clusters);
  const auto count = [](const char* attribute, std::size_t n) {
    return std::string(attribute) + "=\"" + std::to_string(n) + "\"";
  };
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
         "  <PolyData>\n" +
         method_names(cells) + "    <Piece " + count("NumberOfPoints", cells.vertices.size()) +
         count(" NumberOfVerts", cells.points.size()) + count(" NumberOfLines", cells.lines.size()) +
         " NumberOfStrips=\"0\"" + count(" NumberOfPolys", cells.polygons.size()) + ">\n" + cell_data(cells) +
         points_element(cells) + cells_element("Verts", cells.points) + cells_element("Lines", cells.lines) +
         cells_element("Polys", cells.polygons) + "    </Piece>\n  </PolyData>\n</VTKFile>\n";
}

}  // namespace pcl_bv
