// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Each line is one system call: lines of several threads never mix.

#include "messages.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>

namespace pcl_bv {
namespace {

std::mutex mutex;
std::string command;
std::string shown;  // the status line, if there is one
thread_local DeferredMessages* holder = nullptr;

// Errors are ignored, since there is no other place to report them.
void write_error(std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(STDERR_FILENO, text.data(), text.size());
    if (n < 0 && errno != EINTR) return;
    if (n > 0) text.remove_prefix(static_cast<std::size_t>(n));
  }
}

// Overwrites the line with spaces, which works on terminals of every kind.
std::string erasure() {
  return shown.empty() ? "" : '\r' + std::string(shown.size(), ' ') + '\r';
}

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

void name_command(std::string_view name) {
  command = name;
}

void say(std::string_view text) {
  std::string line = (command + ": ").append(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; }, '?');
  const std::lock_guard lock(mutex);
  write_error(erasure() + line + '\n' + shown);
}

void complain(std::string_view problem) {
  holder != nullptr ? void(holder->kept.emplace_back(problem)) : say(problem);
}

void warn_of_subfolders(const std::string& folder, std::size_t subfolders) {
  if (subfolders == 1) complain(folder + ": 1 subfolder is not read");
  if (subfolders > 1) complain(folder + ": " + std::to_string(subfolders) + " subfolders are not read");
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
  shown = line.substr(0, terminal_width() - 1);  // some terminals begin a new line after the last column
  write_error(before + shown);
}

void erase_status_line() {
  const std::lock_guard lock(mutex);
  write_error(erasure());
  shown.clear();
}

}  // namespace pcl_bv
