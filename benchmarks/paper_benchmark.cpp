// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tables 1 to 5 of the paper: on clouds with as many points as its seven meshes have vertices, and on real
// meshes where they are installed. Boxes, k-DOPs and spheres on one core by instruction set, beside plain
// loops; radii; the 26-DOP on one core, on two, on all. Rows as in rows.h.

#include <set>
#include <thread>

#include "meshes.h"
#include "radii.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

const std::vector<CloudName>& point_sets() {
  static const std::vector<CloudName> all = [] {
    std::vector<CloudName> names;
    for (const std::size_t points : kPaperSizes)
      names.push_back({"paper", points});
    for (const Mesh& mesh : meshes())
      names.push_back({mesh.name, mesh.points()});
    return names;
  }();
  return all;
}

void boxes(const CloudName& name) {
  for (const Isa isa : usable_isas()) {
    add_fit("aabb", {Serial{}, isa}, std::string(isa_name(isa)), name,
            [](benchmark::State& state, const Fit&, const Cloud& cloud) {
              if (const Mesh* mesh = find_mesh(cloud.name.scene))
                state.counters["triangles"] = static_cast<double>(mesh->triangles);
            });
  }
  add_fits({"dop14", "dop26"}, usable_isas(), name);
  for (const std::string plain : {"naive-aabb", "naive-dop14", "naive-dop26", "plain-dop26"})
    add_peer(peer(plain), name);
  if (name.points != 100'722) return;  // what the README shows
  for (const std::string pcl : {"pcl-dense", "pcl-non-dense"})
    add_peer(peer(pcl), name);
}

void threads(const CloudName& name) {
  std::set<unsigned> counts{2, std::max(2U, std::thread::hardware_concurrency())};
  for (const unsigned count : counts) {
    for (const Isa isa : {simd_isas().front(), simd_isas().back()})  // the first is the paper's SSE
      add_threads(count, "dop26", isa, name);
  }
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  using namespace pcl_bv::bench;
  for (const CloudName& name : point_sets()) {
    boxes(name);
    add_spheres(name, pcl_bv::usable_isas());
    if (!simd_isas().empty()) threads(name);
  }
  return run_program(argc, argv);
}
