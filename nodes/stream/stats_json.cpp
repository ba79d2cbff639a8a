// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The statistics of a stream as JSON.

#include <nlohmann/json.hpp>

#include <cmath>

#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const LatencyHistogram& ms) {
  const auto rounded = [](double milliseconds) { return std::round(milliseconds * 1e3) / 1e3; };
  return {{"p50", rounded(ms.percentile(0.5))},
          {"p95", rounded(ms.percentile(0.95))},
          {"p99", rounded(ms.percentile(0.99))},
          {"max", rounded(ms.max())}};
}

}  // namespace

std::string stats_json(const RunnerStats& stats) {
  const FrameTotals& frames = stats.frames;
  const StageLatencies& ms = stats.ms;
  Json json{
      {"frames",
       {{"in", frames.in},
        {"processed", frames.processed},
        {"dropped",
         {{"queue", frames.dropped_queue}, {"age", frames.dropped_age}, {"error", frames.dropped_error}}}}},
      {"ms",
       {{"decode", to_json(ms.decode)},
        {"wait", to_json(ms.wait)},
        {"filter", to_json(ms.filter)},
        {"ground", to_json(ms.ground)},
        {"cluster", to_json(ms.cluster)},
        {"fit", to_json(ms.fit)},
        {"track", to_json(ms.track)},
        {"total", to_json(ms.total)},
        {"latency", to_json(ms.latency)}}}};
  if (stats.callback_errors > 0) json["callback_errors"] = stats.callback_errors;
  for (const auto& [name, times] : stats.sinks)
    json["ms"]["sinks"][name] = to_json(times);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);  // sink names may be invalid UTF-8
}

}  // namespace pcl_bv
