// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command bv_stream, which finds objects in a stream of clouds.

#include "commands/shared/interruption.h"
#include "commands/shared/run_command.h"
#include "options.h"
#include "stream.h"

int main(int argc, char** argv) {
  using namespace pcl_bv;
  using namespace pcl_bv::detail;
  return run_command("bv_stream", [&] {
    const auto parsed = parse_stream_options(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) return print_text(*text);
    std::atomic<bool> interrupted{false};  // set by a signal; queued frames are still processed
    const Interruption interruption(interrupted);
    return stream(std::get<StreamOptions>(parsed), interrupted);
  });
}
