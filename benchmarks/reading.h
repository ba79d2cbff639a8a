// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The limit of every kernel: how fast the same bytes can be read at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "clouds.h"
#include "pcl_bv/points/isa.h"

namespace pcl_bv::bench {
using namespace detail;

/// The best way found, among instruction sets, streams and cuts, to read all bytes of a cloud's records.
class Reading {
 public:
  Reading(const Cloud& cloud, unsigned threads);
  void operator()() const;
  /// "avx512 streams:2 pieces:489", for the label of a row.
  std::string text() const;

 private:
  struct Way {
    Isa isa;
    unsigned streams;
    std::size_t pieces;
  };
  std::uint64_t read(const Way& way) const;
  std::vector<Way> ways() const;

  const std::uint64_t* words_;
  std::size_t count_;
  unsigned threads_;
  Way best_;
};

}  // namespace pcl_bv::bench
