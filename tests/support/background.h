// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <gtest/gtest.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace pcl_bv::test {

/// Until it holds, at most 30 s.
inline bool wait_for(const std::function<bool()>& holds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::size_t lines_of(const std::filesystem::path& file) {
  const std::string text = text_of(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// A command that runs beside the test, found in PATH or given by its path; killed at the end.
class Background {
 public:
  /// What it prints on standard error goes to the file `errors`; the rest is not kept.
  Background(std::filesystem::path errors, std::vector<std::string> command) : errors_(std::move(errors)) {
    std::vector<char*> list;
    for (std::string& word : command)
      list.push_back(word.data());
    list.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, errors_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // a group of its own, with its children
    EXPECT_EQ(posix_spawnp(&process_, list.front(), &actions, &attributes, list.data(), environ), 0)
        << list.front();
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    group_ = process_;
  }
  /// Its children end with it: `rosbag play` is a script that starts the player.
  ~Background() {
    if (group_ > 0) kill(-group_, SIGKILL);
    wait();
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  void send(int signal) const { kill(process_, signal); }
  bool ended() const {
    siginfo_t info{};
    return process_ <= 0 || (waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
                             info.si_pid == process_);
  }

  /// Its exit status, 128 + signal if it was killed; -1 if it has been waited for.
  int wait() {
    if (process_ <= 0) return -1;
    int status = 0;
    waitpid(std::exchange(process_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  int end(int signal) {
    if (process_ > 0) kill(process_, signal);
    return wait();
  }
  std::string errors() const { return text_of(errors_); }

 private:
  std::filesystem::path errors_;
  pid_t process_ = 0, group_ = 0;
};

}  // namespace pcl_bv::test
