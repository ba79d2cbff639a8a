// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "meshes.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace pcl_bv::bench {
namespace {

Mesh read_obj(const std::string& name, const std::string& path) {
  Mesh mesh{name, 0, {}};
  std::ifstream in(path);
  for (std::string line, kind; std::getline(in, line);) {
    std::istringstream words(line);
    if (!(words >> kind)) continue;
    mesh.triangles += kind == "f";
    float x, y, z;
    if (kind == "v" && words >> x >> y >> z) mesh.xyz.insert(mesh.xyz.end(), {x, y, z});
  }
  return mesh;
}

Mesh read_off(const std::string& name, const std::string& path) {
  Mesh mesh{name, 0, {}};
  std::ifstream in(path);
  std::string magic;
  std::size_t vertices = 0, edges = 0;
  if (!(in >> magic >> vertices >> mesh.triangles >> edges) || magic != "OFF") return mesh;
  for (float value; mesh.xyz.size() < 3 * vertices && in >> value;)
    mesh.xyz.push_back(value);
  return mesh;
}

// Of CGAL's hundred, kinds of surface that differ, from 4 k vertices on.
const char* const kOfCgal[] = {"homer", "camel", "bear", "diplodocus", "armadillo", "refined_elephant"};

std::vector<Mesh> read_meshes() {
  std::vector<Mesh> all{read_obj("stanford-bunny", "/usr/share/glmark2/models/bunny.obj")};
  if (const char* folder = std::getenv("PCL_BV_MESHES")) {
    for (const std::string name : kOfCgal)
      all.push_back(read_off(name, folder + ('/' + name) + ".off"));
  }
  std::erase_if(all, [](const Mesh& mesh) { return mesh.points() == 0; });
  std::sort(all.begin(), all.end(), [](const Mesh& a, const Mesh& b) { return a.points() < b.points(); });
  return all;
}

}  // namespace

std::vector<float> Mesh::first_points(std::size_t count) const {
  return {xyz.begin(), xyz.begin() + static_cast<std::ptrdiff_t>(std::min(3 * count, xyz.size()))};
}

const std::vector<Mesh>& meshes() {
  static const std::vector<Mesh> all = read_meshes();
  return all;
}

const Mesh* find_mesh(const std::string& name) {
  const auto found =
      std::find_if(meshes().begin(), meshes().end(), [&](const Mesh& mesh) { return mesh.name == name; });
  return found == meshes().end() ? nullptr : &*found;
}

}  // namespace pcl_bv::bench
