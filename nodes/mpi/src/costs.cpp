// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "costs.h"

#include <sys/resource.h>

#include <cstdio>
#include <ctime>
#include <string>

#include "commands/shared/messages.h"

namespace pcl_bv::detail {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

void print_costs(Ranks& ranks, const RankCosts& own) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const std::vector<std::size_t> sums =
      ranks.sum({static_cast<std::size_t>(own.cpu_seconds * 1e6), own.messages, own.bytes});
  const double memory = -ranks.min_over_ranks({-static_cast<double>(usage.ru_maxrss)}).front();
  if (!ranks.first()) return;
  const std::string rounds =
      own.query_rounds ? std::to_string(*own.query_rounds) + " query rounds, " : std::string();
  char text[240];
  std::snprintf(text, sizeof text,
                "%zu ranks: %.3f s wall time, %.3f s CPU time, %s%zu messages with %zu bytes in total, "
                "maximum memory of a "
                "rank %.0f KiB",
                ranks.size(), own.seconds, static_cast<double>(sums[0]) / 1e6, rounds.c_str(), sums[1],
                sums[2], memory);
  print_message(text);
}

}  // namespace pcl_bv::detail
