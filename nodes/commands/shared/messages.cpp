// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes each line by one system call while a mutex is locked, so that lines never mix.

#include "messages.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <mutex>
#include <utility>

#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::detail {
namespace {

std::mutex mutex;
std::string command;
std::string status_line;            // empty if none is shown
std::vector<std::string> problems;  // if the program is no command
thread_local DeferredMessages* holder = nullptr;

// Ignores errors, because they cannot be reported elsewhere.
void write_error(std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(STDERR_FILENO, text.data(), text.size());
    if (n < 0 && errno != EINTR) return;
    if (n > 0) text.remove_prefix(static_cast<std::size_t>(n));
  }
}

// Returns a text that overwrites the status line with spaces, which works on all kinds of terminals.
std::string erasure() {
  return status_line.empty() ? "" : '\r' + std::string(status_line.size(), ' ') + '\r';
}

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

void name_command(std::string_view name) {
  command = name;
}

void print_message(std::string_view text) {
  const std::string line = message_line((command + ": ").append(text));
  const std::lock_guard lock(mutex);
  write_error(erasure() + line + '\n' + status_line);
}

void report_problem(std::string_view problem) {
  if (holder != nullptr) {
    holder->messages.emplace_back(problem);
  } else if (!command.empty()) {
    print_message(problem);
  } else {
    const std::lock_guard lock(mutex);
    problems.emplace_back(message_line(problem));
  }
}

std::vector<std::string> take_problems() {
  const std::lock_guard lock(mutex);
  return std::exchange(problems, {});
}

void warn_of_subfolders(const std::string& folder, std::size_t subfolders) {
  if (subfolders == 1) report_problem(folder + ": 1 subfolder is not read");
  if (subfolders > 1) report_problem(folder + ": " + std::to_string(subfolders) + " subfolders are not read");
}

DeferredMessages::DeferredMessages() {
  holder = this;
}

DeferredMessages::~DeferredMessages() {
  holder = nullptr;
}

bool errors_go_to_a_terminal() {
  return isatty(STDERR_FILENO) != 0;
}

void show_status_line(std::string_view line) {
  const std::lock_guard lock(mutex);
  const std::string before = erasure();
  // The last column stays empty, because some terminals begin a new line after it.
  status_line = line.substr(0, terminal_width() - 1);
  write_error(before + status_line);
}

void erase_status_line() {
  const std::lock_guard lock(mutex);
  write_error(erasure());
  status_line.clear();
}

}  // namespace pcl_bv::detail
