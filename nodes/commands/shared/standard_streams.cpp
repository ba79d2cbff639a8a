// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Uses POSIX calls without a buffer, so that a failed write is reported by this write, not by a later one.

#include "standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "pcl_bv/io/growing_file.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {

void prepare_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit of `ulimit -f` fails instead
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    if (fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // /dev/null is opened for the wrong direction, so that writing to a standard output that was closed at
    // the start fails.
    const int mode = descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (open("/dev/null", mode) != descriptor) _exit(EXIT_FAILURE);
  }
}

bool write_standard_output(std::string_view text) {
  const int error = write_whole(STDOUT_FILENO, text);
  if (error != 0 && error != EPIPE) throw IoError(system_reason(error));
  return error == 0;
}

}  // namespace pcl_bv::detail
