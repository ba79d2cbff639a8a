// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which instruction set runs: an argument of every call, never global state.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// An instruction set for which the kernels are compiled. `scalar` is the scalar reference; every set gives
/// the same bits. `automatic` is the set named by the environment variable PCL_BV_ISA, else the machine's
/// best; of 64-bit Arm's NEON, SVE only on request.
enum class Isa : std::uint8_t { automatic, scalar, sse4, avx2, avx512, neon, sve, sve2 };

/// The name used on command lines and in PCL_BV_ISA: "auto", "scalar", "sse4", ...
std::string_view isa_name(Isa isa);

/// The reverse of isa_name(). Throws std::invalid_argument, listing the known names, for any other text.
Isa parse_isa(std::string_view name);

/// The sets that this build and this machine can run, slowest (scalar) first.
std::vector<Isa> usable_isas();

/// An instruction set that this build and this machine can run, and no other: what kernels and fits take.
class UsableIsa {
 public:
  /// Not explicit: an Isa says enough. `automatic` is looked up here, once: copies do not ask the environment
  /// again. Throws std::invalid_argument if the set is not usable here or if PCL_BV_ISA, when asked, holds an
  /// unknown name.
  UsableIsa(Isa isa = Isa::automatic);

  operator Isa() const { return isa_; }  ///< Never `automatic`.

 private:
  Isa isa_;
};

}  // namespace pcl_bv
