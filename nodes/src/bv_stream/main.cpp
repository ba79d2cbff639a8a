// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command bv_stream: objects in a stream of clouds.

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "command/run_command.h"
#include "options.h"
#include "stream.h"

namespace {

using namespace pcl_bv;

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// The first signal lets the queue be done, the second one ends at once.
extern "C" void on_signal(int) {
  if (interrupted.exchange(true)) _exit(130);
}

void catch_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, &action, &before);
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) sigaction(signal, &before, nullptr);  // nohup
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_command("bv_stream", [&] {
    const auto asked = parse_stream_options(argc, argv);
    if (const auto* text = std::get_if<std::string>(&asked)) return print(*text);
    catch_signals();
    return stream(std::get<StreamOptions>(asked), interrupted);
  });
}
