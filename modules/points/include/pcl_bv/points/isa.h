// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The instruction set of the kernels. It is an argument of every kernel, never global state.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// An instruction set for which the kernels are compiled. Results have the same bits for every set. `scalar`
/// is the scalar reference. `automatic` is the set named by the environment variable PCL_BV_ISA or, without
/// this variable, the best set of the machine. On 64-bit Arm the best set is NEON; SVE runs only on request.
enum class Isa : std::uint8_t { automatic, scalar, sse4, avx2, avx512, neon, sve, sve2 };

/// Returns the name used on command lines and in PCL_BV_ISA: "auto", "scalar", "sse4", ...
std::string_view isa_name(Isa isa);

/// Returns the instruction set called `name`; this is the inverse of isa_name(). Throws
/// std::invalid_argument, with a list of the known names, for any other text.
Isa parse_isa(std::string_view name);

/// Returns the instruction sets that this build and this machine can run, in the order of Isa (scalar first).
std::vector<Isa> usable_isas();

/// An instruction set that this build and this machine can certainly run. Kernels and fits take this type.
class UsableIsa {
 public:
  /// Implicit, so that an Isa can be passed where a UsableIsa is expected. The constructor resolves
  /// `automatic`, and copies do not read the environment again. Throws std::invalid_argument if the set is
  /// not usable on this machine, or if PCL_BV_ISA is read and holds an unknown name.
  UsableIsa(Isa isa = Isa::automatic);

  operator Isa() const { return isa_; }  ///< Never `automatic`.

 private:
  Isa isa_;
};

}  // namespace pcl_bv
