// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tilesets.h"

#include <string>
#include <vector>

#include "commands/shared/messages.h"
#include "commands/shared/standard_streams.h"
#include "commands/shared/values.h"
#include "pcl_bv/report/tileset.h"

namespace pcl_bv::detail {

Status update_tilesets(const Options& options) {
  constexpr std::size_t kMaxProblems = 10;  // lines for each tileset
  std::vector<const Method*> boxes;
  for (const Method* method : options.pipeline.methods())
    if (method->shape == "aabb" || method->shape == "obb") boxes.push_back(method);
  if (boxes.empty()) throw UsageError("--update: needs a box: --volume aabb, obb, obb-dito14, ...");
  Status status = Status::done;
  for (const std::string& input : options.inputs) {
    try {
      const TilesetUpdate update = update_tileset(input, boxes, options.pipeline.execution());
      for (std::size_t i = 0; i < std::min(kMaxProblems, update.problems.size()); ++i)
        print_message(input + ": " + update.problems[i]);
      if (update.problems.size() > kMaxProblems)
        print_message(input + ": " + std::to_string(update.problems.size() - kMaxProblems) + " more tiles");
      if (!update.problems.empty()) status = Status::failed;
      write_standard_output(input + ": " + std::to_string(update.updated) + " of " +
                            std::to_string(update.tiles) + " tiles updated\n");
    } catch (const IoError& error) {
      print_message(input + ": " + error.what());
      status = Status::failed;
    }
  }
  return status;
}

}  // namespace pcl_bv::detail
