// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// MXCSR on x86, FPCR on Arm. Compiled on its own: a compiler that could look inside would be free to move
// arithmetic past the change of a register that it takes for unrelated.

#include "pcl_bv/numeric/float_environment.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace pcl_bv {
namespace {

#if defined(__x86_64__)
constexpr std::uint64_t kDefault = 0x1F80;  // all exceptions masked, round to nearest, no FTZ, no DAZ
constexpr std::uint64_t kFlags = 0x3F;      // of exceptions that were raised: no settings
std::uint64_t read_control() {
  return _mm_getcsr();
}
void write_control(std::uint64_t value) {
  _mm_setcsr(static_cast<unsigned>(value));
}
#elif defined(__aarch64__)
constexpr std::uint64_t kDefault = 0;
constexpr std::uint64_t kFlags = 0;
std::uint64_t read_control() {
  std::uint64_t value;
  asm volatile("mrs %0, fpcr" : "=r"(value));
  return value;
}
void write_control(std::uint64_t value) {
  asm volatile("msr fpcr, %0" : : "r"(value) : "memory");
}
#else
#error "pcl_bv needs to control denormals: add this architecture's floating-point control register here"
#endif

// To write the register takes some 20 cycles, to read it few, and small verbs hold a guard, too.
bool same_settings(std::uint64_t a, std::uint64_t b) {
  return ((a ^ b) & ~kFlags) == 0;
}

}  // namespace

FloatEnvironment::FloatEnvironment() : saved_(read_control()) {
  if (!same_settings(saved_, kDefault)) write_control(kDefault);
}
FloatEnvironment::~FloatEnvironment() {
  if (!same_settings(saved_, read_control())) write_control(saved_);
}

}  // namespace pcl_bv
