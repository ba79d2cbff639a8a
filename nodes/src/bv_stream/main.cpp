// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command bv_stream: objects in a stream of clouds.

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>

#include "options.h"
#include "pcl_bv/io/io_error.h"
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
  for (const int signal : {SIGINT, SIGTERM})
    sigaction(signal, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error of write(), seen where it happens
}

// Files must not get the numbers of standard streams that somebody has closed.
void keep_standard_streams() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    if (fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    if (open("/dev/null", O_RDWR) != descriptor) _exit(1);
  }
}

int fail(int status, const char* problem) {
  std::fprintf(stderr, "bv_stream: %s\n", problem);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  keep_standard_streams();
  try {
    const auto asked = parse_stream_options(argc, argv);
    if (const auto* text = std::get_if<std::string>(&asked)) {
      const bool written = std::fputs(text->c_str(), stdout) >= 0 && std::fflush(stdout) == 0;
      return written ? 0 : fail(1, "standard output: cannot be written");
    }
    catch_signals();
    return stream(std::get<StreamOptions>(asked), interrupted);
  } catch (const UsageError& error) {
    return fail(2, error.what());
  } catch (const ConfigError& error) {
    return fail(2, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(2, error.what());
  } catch (const std::exception& error) {
    return fail(1, error.what());
  }
}
