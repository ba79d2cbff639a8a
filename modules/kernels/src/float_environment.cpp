// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// MXCSR on x86, FPCR on Arm.

#include "pcl_bv/kernels/float_environment.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace pcl_bv {
namespace {

#if defined(__x86_64__)
constexpr std::uint64_t kDefault = 0x1F80;  // all exceptions masked, round to nearest, no FTZ, no DAZ
std::uint64_t read_control() {
  return _mm_getcsr();
}
void write_control(std::uint64_t value) {
  _mm_setcsr(static_cast<unsigned>(value));
}
#elif defined(__aarch64__)
constexpr std::uint64_t kDefault = 0;
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

}  // namespace

FloatEnvironment::FloatEnvironment() : saved_(read_control()) {
  write_control(kDefault);
}
FloatEnvironment::~FloatEnvironment() {
  write_control(saved_);
}

}  // namespace pcl_bv
