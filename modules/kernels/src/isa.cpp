// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/points/isa.h"

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "targets.h"
// targets.h must be included before Highway's headers, because it configures Highway.
#include <hwy/highway.h>
#include <hwy/targets.h>

namespace pcl_bv {
using namespace detail;
namespace {

struct Entry {
  Isa isa;
  std::string_view name;
  std::int64_t target;  // Highway's bit for the instruction set; 0 for `automatic` and `scalar`.
};

constexpr std::array<Entry, 8> kEntries = {{{Isa::automatic, "auto", 0},
                                            {Isa::scalar, "scalar", 0},
                                            {Isa::sse4, "sse4", HWY_SSE4},
                                            {Isa::avx2, "avx2", HWY_AVX2},
                                            {Isa::avx512, "avx512", HWY_AVX3},
                                            {Isa::neon, "neon", PCL_BV_NEON},
                                            {Isa::sve, "sve", HWY_SVE},
                                            {Isa::sve2, "sve2", HWY_SVE2}}};

#if HWY_ARCH_X86 && HWY_COMPILER_GCC && !HWY_COMPILER_CLANG  // clang does not know all feature names below
// Queries the compiler's runtime for the features with which Highway compiles each target. Highway's own
// detection is not used, because it is in libhwy, and in a program that links libhwy, Highway calibrates a
// timer before main(). The calibration took 3.1 of the 6.9 ms in which pcd_bv started.
std::int64_t machine_targets() {
  __builtin_cpu_init();
  const bool sse4 = __builtin_cpu_supports("ssse3") && __builtin_cpu_supports("sse4.1") &&
                    __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") &&
                    __builtin_cpu_supports("aes");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx") && __builtin_cpu_supports("avx2") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                    __builtin_cpu_supports("fma") && __builtin_cpu_supports("f16c");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  return (sse4 ? HWY_SSE4 : 0) | (avx2 ? HWY_AVX2 : 0) | (avx512 ? HWY_AVX3 : 0);
}
#else
std::int64_t machine_targets() {
  return hwy::SupportedTargets();
}
#endif

// Queries the processor only once, because in a virtual machine CPUID traps and takes 15 us.
bool usable(const Entry& entry) {
  static const std::int64_t supported = HWY_TARGETS & machine_targets();
  return entry.isa == Isa::scalar || (entry.target & supported) != 0;
}

// Returns the default instruction set. NEON is preferred to SVE for two reasons. First, with SVE, points of
// index lists and wide records are loaded coordinate by coordinate (Layout::any in load-inl.h). Second, SVE
// vectors are no longer than NEON vectors on most processors.
Isa best_isa() {
  Isa best = Isa::scalar;
  for (const Entry& entry : kEntries) {
    if (entry.isa <= Isa::neon && usable(entry)) best = entry.isa;
  }
  return best;
}

std::string list_names(bool (*listed)(const Entry&)) {
  std::string text;
  for (const Entry& entry : kEntries) {
    if (listed(entry)) text.append(text.empty() ? "" : ", ").append(entry.name);
  }
  return text;
}

}  // namespace

std::string_view isa_name(Isa isa) {
  const auto entry = static_cast<std::size_t>(isa);
  return entry < kEntries.size() ? kEntries[entry].name : "unknown";
}

Isa parse_isa(std::string_view name) {
  for (const Entry& entry : kEntries) {
    if (entry.name == name) return entry.isa;
  }
  throw std::invalid_argument("unknown instruction set '" + std::string(name) +
                              "' (known: " + list_names([](const Entry&) { return true; }) + ")");
}

std::vector<Isa> usable_isas() {
  std::vector<Isa> isas;
  for (const Entry& entry : kEntries) {
    if (usable(entry)) isas.push_back(entry.isa);
  }
  return isas;
}

UsableIsa::UsableIsa(Isa isa) : isa_(isa) {
  if (isa_ == Isa::automatic) {
    const char* name = std::getenv("PCL_BV_ISA");
    if (name != nullptr && *name != '\0') isa_ = parse_isa(name);
  }
  if (isa_ == Isa::automatic) isa_ = best_isa();
  const auto entry = static_cast<std::size_t>(isa_);
  if (entry < kEntries.size() && usable(kEntries[entry])) return;
  throw std::invalid_argument("instruction set '" + std::string(isa_name(isa_)) +
                              "' is not usable here (usable: " + list_names(usable) + ")");
}

}  // namespace pcl_bv
