// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One instruction set, without the kernels: every Execution has a set, and settings name one.
#include <stdexcept>

#include "pcl_bv/points/isa.h"

namespace pcl_bv {

Isa parse_isa(std::string_view name) {
  if (name != "auto") throw std::invalid_argument("no such instruction set");
  return Isa::automatic;
}
std::string_view isa_name(Isa) {
  return "auto";
}
std::vector<Isa> usable_isas() {
  return {Isa::automatic};
}
UsableIsa::UsableIsa(Isa isa) : isa_(isa) {}

}  // namespace pcl_bv
