// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Included first by every source of the copy that mutants.py builds: all mutants are in one program, and the
// environment says which of them lives.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace pcl_bv_mutants {

constexpr int kMaxSlots = 1 << 16;

inline unsigned char slots[kMaxSlots];    // that are to be looked at
inline unsigned char reached[kMaxSlots];  // while recording
inline const char* record_file = nullptr;
inline int active = -1;

inline void write_record() {
  std::FILE* file = std::fopen(record_file, "w");
  if (file == nullptr) return;
  for (int slot = 0; slot < kMaxSlots; ++slot) {
    if (reached[slot] != 0) std::fprintf(file, "%d\n", slot);
  }
  std::fclose(file);
}

// PCL_BV_MUTANT=SLOT:MUTANT, or PCL_BV_MUTANT_RECORD=FILE for the slots that were reached.
inline bool start() {
  int slot = 0;
  const char* mutant = std::getenv("PCL_BV_MUTANT");
  if (mutant != nullptr && std::sscanf(mutant, "%d:%d", &slot, &active) == 2) slots[slot] = 1;
  record_file = std::getenv("PCL_BV_MUTANT_RECORD");
  if (record_file != nullptr) {
    std::memset(slots, 1, sizeof slots);
    std::atexit(write_record);
  }
  return true;
}
inline const bool started = start();

// One look at a byte is all that a slot costs where its mutants sleep and nothing is recorded.
inline bool enter(int slot) {
  if (record_file == nullptr) return true;
  reached[slot] = 1;
  slots[slot] = 0;
  return false;
}

}  // namespace pcl_bv_mutants

#define PCL_BV_SLOT(n) (__builtin_expect(::pcl_bv_mutants::slots[n], 0) && ::pcl_bv_mutants::enter(n))
#define PCL_BV_IS(n) (::pcl_bv_mutants::active == (n))
