// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs the built commands.

#include "command.h"

#include <fcntl.h>
#include <pty.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>

extern char** environ;

namespace pcl_bv::test {
namespace {

std::vector<std::string> environment(const std::string& isa) {
  std::vector<std::string> variables;
  for (char** entry = environ; *entry; ++entry) {
    if (isa.empty() || !std::string_view(*entry).starts_with("PCL_BV_ISA=")) variables.emplace_back(*entry);
  }
  if (!isa.empty()) variables.push_back("PCL_BV_ISA=" + isa);
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts)
    list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

int write_end_without_reader() {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  close(ends[0]);
  return ends[1];
}

/// A terminal for standard error.
class Terminal {
 public:
  Terminal() {
    winsize size{};
    size.ws_col = 80;
    if (openpty(&ours_, &theirs_, nullptr, nullptr, &size) != 0) throw std::runtime_error("no terminal");
  }
  ~Terminal() { close(ours_); }

  int theirs() const { return theirs_; }

  /// All that is written until the last writer is gone.
  std::string read() {
    close(theirs_);
    std::string text;
    char buffer[4096];
    for (ssize_t n; (n = ::read(ours_, buffer, sizeof buffer)) > 0;)
      text.append(buffer, static_cast<std::size_t>(n));
    return text;
  }

 private:
  int ours_ = -1, theirs_ = -1;
};

int spawn_and_wait(std::vector<std::string> arguments, std::vector<std::string> variables,
                   const posix_spawn_file_actions_t& actions, Terminal* terminal,
                   const std::function<void(int)>& meanwhile, std::string& shown) {
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t interrupts;  // which some shells ignore in the background
  sigemptyset(&interrupts);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    sigaddset(&interrupts, signal);
  posix_spawnattr_setsigdefault(&attributes, &interrupts);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t child = 0;
  const int error = posix_spawn(&child, arguments[0].c_str(), &actions, &attributes,
                                pointers(arguments).data(), pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw std::runtime_error("cannot start " + arguments[0]);
  if (meanwhile) meanwhile(child);
  if (terminal != nullptr) shown = terminal->read();
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

std::size_t Result::error_lines() const {
  return static_cast<std::size_t>(std::count(err.begin(), err.end(), '\n'));
}

std::string Result::problems() const {
  static const std::regex summary(
      "pcd_bv: [0-9]+ files: [0-9]+ done, [0-9]+ failed, [0-9]+ points, [0-9.]+ s\n$");
  return std::regex_replace(err, summary, "");
}

bool has_terminals() {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal >= 0) close(terminal);
  return terminal >= 0;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Result PcdBv::run(const std::vector<std::string>& arguments, const Surroundings& surroundings) const {
  const std::string captured = at("captured.out"), errors = at("captured.err");
  const std::string out = surroundings.output.empty() ? captured : surroundings.output;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const int dead_end = surroundings.nobody_reads ? write_end_without_reader() : -1;
  if (dead_end >= 0) {
    posix_spawn_file_actions_adddup2(&actions, dead_end, STDOUT_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0644);
  }
  std::optional<Terminal> terminal;
  if (surroundings.terminal) {
    posix_spawn_file_actions_adddup2(&actions, terminal.emplace().theirs(), STDERR_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0644);
  }
  for (const int descriptor : surroundings.closed)
    posix_spawn_file_actions_addclose(&actions, descriptor);
  const std::string& program = surroundings.program;
  std::vector<std::string> command{program.front() == '/' ? program : PCL_BV_BIN_DIR "/" + program};
  command.insert(command.end(), arguments.begin(), arguments.end());
  Result result;
  std::string shown;
  result.status = spawn_and_wait(std::move(command), environment(surroundings.isa), actions,
                                 terminal ? &*terminal : nullptr, surroundings.meanwhile, shown);
  posix_spawn_file_actions_destroy(&actions);
  if (dead_end >= 0) close(dead_end);
  result.out = read_file(captured);
  result.err = surroundings.terminal ? shown : read_file(errors);
  std::filesystem::remove(captured);
  std::filesystem::remove(errors);
  return result;
}

std::string PcdBv::file(std::string_view name, std::string_view content) const {
  const std::filesystem::path path = folder_ / name;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << content;
  return path.string();
}

std::string PcdBv::header(std::size_t points, std::string_view data) {
  const std::string n = std::to_string(points);
  return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + n +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA " + std::string(data) + "\n";
}

std::string PcdBv::ascii(std::string_view name, const std::vector<std::string>& points) const {
  std::string content = header(points.size());
  for (const std::string& point : points)
    content += point + '\n';
  return file(name, content);
}

}  // namespace pcl_bv::test
