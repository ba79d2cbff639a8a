// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tries every way a few times and keeps the one with the least minimum.

#include "reading.h"

#include <benchmark/benchmark.h>

#include "fits.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "rivals.h"
#include "timing.h"

namespace pcl_bv::bench {
using namespace detail;

Reading::Reading(const Cloud& cloud, unsigned threads)
    : words_(reinterpret_cast<const std::uint64_t*>(cloud.view.data)),
      count_(cloud.view.stride * cloud.view.count / sizeof(std::uint64_t)),
      threads_(threads),
      best_{Isa::scalar, 1, 1} {
  const std::uint64_t expected = read(best_);
  double least = 1e9;
  for (const Way& way : ways()) {
    require(read(way) == expected, "a way to read gives another result");
    const auto run = [&] { benchmark::DoNotOptimize(read(way)); };
    const int times = times_for(run);
    for (int i = 0; i < 5; ++i) {
      const double time = seconds(run, times);
      if (time < least) least = time, best_ = way;
    }
  }
}

// In pieces the size of our chunks, or one for each thread.
std::vector<Reading::Way> Reading::ways() const {
  const std::size_t chunk = kChunkPoints * 16 / sizeof(std::uint64_t);
  const std::size_t chunks = (count_ + chunk - 1) / chunk;
  std::vector<Way> all;
  for (const Isa isa : usable_isas()) {
    if (isa == Isa::scalar) continue;
    for (const unsigned streams : {1U, 2U, 4U, 8U}) {
      all.push_back({isa, streams, threads_});
      if (chunks > threads_) all.push_back({isa, streams, chunks});
    }
  }
  return all;
}

std::uint64_t Reading::read(const Way& way) const {
  const std::size_t piece = (count_ + way.pieces - 1) / way.pieces;
  const auto read_piece = [&](std::size_t i) {
    const std::size_t begin = std::min(i * piece, count_);
    return read_words(way.isa, words_ + begin, std::min(piece, count_ - begin), way.streams);
  };
  if (way.pieces == 1) return read_piece(0);
  const ParallelPolicy policy = policy_of(threads_);
  return reduce_chunks(policy, way.pieces, std::uint64_t{0}, read_piece,
                       [](std::uint64_t& sum, std::uint64_t part) { sum ^= part; });
}

void Reading::operator()() const {
  benchmark::DoNotOptimize(read(best_));
}

std::string Reading::text() const {
  return std::string(isa_name(best_.isa)) + " streams:" + std::to_string(best_.streams) +
         " pieces:" + std::to_string(best_.pieces);
}

}  // namespace pcl_bv::bench
