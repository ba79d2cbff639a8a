// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command pcd_bv: bounding volumes of the clouds it is given.

#include <csignal>
#include <exception>

#include "inputs.h"
#include "options.h"
#include "output.h"
#include "pcl_bv/io/io_error.h"
#include "process.h"
#include "status.h"

namespace {

using namespace pcl_bv;

/// Does all jobs. A reader that goes away ends the work without complaint.
Status run(const Options& options) {
  const std::vector<Job> jobs = plan_jobs(options);
  ReportWriter writer(options.format, options.output);
  Status status = Status::done;
  try {
    for (const Job& job : jobs) {
      const Outcome outcome = process(job, options);
      status = worse(status, outcome.status);
      // Nobody reads any more; what else was asked for is done all the same.
      if (!writer.add(outcome.report) && !writes_files(options) && !options.check) return status;
    }
    writer.finish();
  } catch (const IoError& error) {
    complain((options.output ? options.output->string() : "standard output") + ": " + error.what());
    status = worse(status, Status::failed);
  }
  return status;
}

Status run(int argc, char** argv) {
  try {
    const auto asked = parse_options(argc, argv);
    if (const auto* options = std::get_if<Options>(&asked)) return run(*options);
    write_standard_output(std::get<std::string>(asked));
    return Status::done;
  } catch (const UsageError& error) {
    complain(error.what());
    return Status::misuse;
  } catch (const IoError& error) {
    complain(std::string("standard output: ") + error.what());
    return Status::failed;
  } catch (const std::exception& error) {
    complain(std::string("internal error: ") + error.what());
    return Status::failed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error of write(), seen where it happens
  return static_cast<int>(run(argc, argv));
}
