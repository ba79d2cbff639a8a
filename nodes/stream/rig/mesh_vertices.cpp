// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The vertices of meshes in STL and OBJ. Edges are not needed, because a hull has only vertices.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/number_text.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "urdf.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMaxMeshBytes = std::size_t{1} << 30;
constexpr std::size_t kMaxVertices = 10'000'000;
constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;

using Vertices = std::vector<Eigen::Vector3d>;

// A binary STL may begin with "solid", too, so its size decides: a header with the number of triangles, then
// 50 bytes for each of them.
bool is_binary_stl(const std::string& bytes) {
  if (bytes.size() < kStlHeader) return false;
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, bytes.data() + kStlHeader - sizeof triangles, sizeof triangles);
  return bytes.size() == kStlHeader + kStlTriangle * std::size_t{triangles};
}

void check_count(std::size_t vertices) {
  if (vertices > kMaxVertices) throw IoError("has more than 10000000 vertices");
}

Vertices binary_stl(const std::string& bytes) {
  Vertices vertices;
  check_count(3 * ((bytes.size() - kStlHeader) / kStlTriangle));
  for (std::size_t at = kStlHeader; at + kStlTriangle <= bytes.size(); at += kStlTriangle) {
    float corners[12];  // the normal, then three corners
    std::memcpy(corners, bytes.data() + at, sizeof corners);
    for (std::size_t k = 3; k < 12; k += 3)
      vertices.emplace_back(corners[k], corners[k + 1], corners[k + 2]);
  }
  return vertices;
}

// Returns the numbers of the lines that begin with `keyword`: "vertex" of STL, "v" of OBJ.
Vertices text_vertices(const std::string& text, const std::string& keyword) {
  constexpr std::string_view blanks = " \t\r\v\f";
  Vertices vertices;
  std::istringstream stream(text);
  std::size_t line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    std::string_view rest(line);
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    const std::string_view first = rest.substr(0, rest.find_first_of(blanks));
    if (first != keyword) continue;
    rest.remove_prefix(first.size());
    Eigen::Vector3d vertex;
    if (!next_number(rest, vertex.x()) || !next_number(rest, vertex.y()) || !next_number(rest, vertex.z()) ||
        !vertex.allFinite())
      throw IoError("line " + std::to_string(line_number) + ": not three finite numbers");
    vertices.push_back(vertex);
    check_count(vertices.size());
  }
  return vertices;
}

}  // namespace

std::vector<Eigen::Vector3d> read_mesh_vertices(const std::filesystem::path& file) {
  const std::string extension = lower_case_extension(file);
  if (extension != ".stl" && extension != ".obj")
    throw IoError("meshes can be read as .stl or .obj, not as '" + extension + "'");
  const std::string bytes = read_untrusted_text(file, kMaxMeshBytes);
  Vertices vertices = extension == ".obj"    ? text_vertices(bytes, "v")
                      : is_binary_stl(bytes) ? binary_stl(bytes)
                                             : text_vertices(bytes, "vertex");
  if (vertices.empty()) throw IoError("has no vertices");
  return vertices;
}

}  // namespace pcl_bv::detail
