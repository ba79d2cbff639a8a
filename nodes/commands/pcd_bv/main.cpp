// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command pcd_bv, which computes bounding volumes of point clouds.

#include "commands/shared/output_claims.h"
#include "commands/shared/run_command.h"
#include "inputs.h"
#include "options.h"
#include "process.h"
#include "shares.h"
#include "tilesets.h"
#include "watch.h"

int main(int argc, char** argv) {
  using namespace pcl_bv;
  using namespace pcl_bv::detail;
  return run_command("pcd_bv", [&] {
    const auto parsed = parse_options(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) return print_text(*text);
    const auto& options = std::get<Options>(parsed);
    if (options.output) require_folder_of(*options.output);
    if (options.update) return static_cast<int>(update_tilesets(options));
    if (options.watch) return static_cast<int>(watch_folder(options));
    const std::vector<Job> jobs = plan_jobs(options);
    if (options.partial) return static_cast<int>(make_partial_file(jobs.front(), options));
    return static_cast<int>(process_all(jobs, options));
  });
}
