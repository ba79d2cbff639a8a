// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command pcd_bv_mpi: pcd_bv distributed over MPI ranks.

#include <exception>
#include <functional>
#include <new>

#include "commands/pcd_bv/ordered_results.h"
#include "commands/shared/interruption.h"
#include "commands/shared/messages.h"
#include "commands/shared/run_command.h"
#include "commands/shared/values.h"
#include "distributed_jobs.h"
#include "failures.h"
#include "merged_cloud.h"
#include "merged_objects.h"
#include "pcl_bv/io/untrusted_text.h"
#include "ranks.h"

namespace pcl_bv::detail {
namespace {

/// A collective call. Calls work() on every rank. The first rank prints the warnings of its own work(). If
/// work() throws UsageError on any rank, all ranks return false and the first rank prints the reason.
bool run_on_all_ranks(Ranks& ranks, const std::function<void()>& work) {
  std::string problem;
  {
    const DeferredMessages held;
    try {
      work();
    } catch (const UsageError& error) {
      problem = error.what();
    }
    if (ranks.first()) {
      for (const std::string& complaint : held.messages)
        print_message(complaint);
    }
  }
  for (const std::string& each : ranks.all_gather(problem)) {
    if (each.empty()) continue;
    if (ranks.first()) report_problem(each);
    return false;
  }
  return true;
}

void check_options_for_ranks(const Options& options) {
  if (options.tiled && (options.image || options.view_html || options.info))
    throw UsageError("--together: cannot be combined with --image, --view-html or --info over ranks");
}

std::string names_of(const std::vector<Job>& inputs) {
  std::string names;
  for (const Job& input : inputs)
    names += input.input + '\n';
  return names;
}

Status process_merged(Ranks& ranks, const Job& job, const Options& options, InterruptAction& interrupted) {
  Outcome outcome;
  outcome.report.file = job.input;
  try {
    outcome.status = options.clusters()
                         ? find_merged_objects(ranks, job, options, outcome.report, interrupted)
                         : fit_merged(ranks, *job.tiles, options, outcome.report);
  } catch (const IoError& error) {  // thrown on all ranks
    outcome.report.error = error.what();
    outcome.status = Status::failed;
  }
  if (!ranks.first()) return Status::done;
  if (outcome.report.error) {
    report_problem(job.input + ": " + *outcome.report.error);
  } else {
    outcome.status = worse(outcome.status, write_mesh(job, outcome.report.clusters));
  }
  OrderedResults order(options, 1, 1);
  interrupted.set([&] { order.interrupt(); });
  order.add_result(0, result_of(outcome, render_options(options, job.frame)));
  const Status status = order.finish();
  interrupted.set(nullptr);
  return status;
}

int run(Ranks& ranks, int argc, char** argv, InterruptAction& interrupted) {
  std::variant<Options, std::string> parsed;
  std::vector<Job> inputs, jobs;
  const bool valid = run_on_all_ranks(ranks, [&] {
    parsed = parse_options(argc, argv, PcdBvCommand::mpi);
    const auto* const options = std::get_if<Options>(&parsed);
    if (options == nullptr) return;
    check_options_for_ranks(*options);
    inputs = list_inputs(*options);
  });
  if (!valid) return static_cast<int>(Status::misuse);
  if (const auto* text = std::get_if<std::string>(&parsed)) return ranks.first() ? print_text(*text) : 0;
  Options options = std::get<Options>(parsed);
  if (!options.threads_given) options.pipeline.threads = 1;  // usually there is one rank per processor
  if (ranks.broadcast(names_of(inputs)) != names_of(inputs))
    throw IoError(
        "the list of inputs differs from that of rank 0: all ranks need the same files at the same paths");
  std::shared_ptr<Tiles> tiles;
  if (options.tiled)
    tiles = std::make_shared<Tiles>(inputs, describe_tiles(ranks, inputs),
                                    thread_count(options.pipeline.execution().parallel));
  if (!run_on_all_ranks(ranks, [&] { jobs = plan_jobs(options, std::move(inputs), tiles); }))
    return static_cast<int>(Status::misuse);
  const Status status = options.tiled ? process_merged(ranks, jobs.front(), options, interrupted)
                                      : process_jobs(ranks, jobs, options, interrupted);
  return static_cast<int>(status);
}

}  // namespace
}  // namespace pcl_bv::detail

int main(int argc, char** argv) {
  using namespace pcl_bv;
  using namespace pcl_bv::detail;
  return run_command("pcd_bv_mpi", [&]() -> int {
    InterruptAction interrupted;
    const Interruption interruption([&] { interrupted(); });  // before MPI starts its threads
    Ranks ranks(&argc, &argv);
    std::string reason;
    try {
      const int status = run(ranks, argc, argv, interrupted);
      return ranks.first() ? status : 0;
    } catch (const std::exception& error) {
      reason = reason_of(error);
    }
    print_message("rank " + std::to_string(ranks.rank()) + ": " + reason);
    Ranks::abort();  // the other ranks may be waiting for this rank
  });
}
