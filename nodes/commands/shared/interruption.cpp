// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A thread waits for SIGINT, SIGTERM and SIGHUP. A signal handler could not do the work, because it must not
// lock a mutex, remove files by name or write JSON.

#include "interruption.h"

#include <pthread.h>
#include <unistd.h>

#include <system_error>
#include <utility>

#include "pcl_bv/io/atomic_file.h"

namespace pcl_bv::detail {
namespace {

// The signal that ends the watching thread.
int stop_signal() {
  return SIGRTMIN;
}

bool is_ignored(int signal) {
  struct sigaction action = {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler == SIG_IGN;
}

[[noreturn]] void end_with(int signal) {
  remove_temporary_files();
  _exit(128 + signal);
}

}  // namespace

void Interruption::start() {
  sigemptyset(&handled_signals_);
  sigaddset(&handled_signals_, stop_signal());
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (!is_ignored(signal)) sigaddset(&handled_signals_, signal);
  }
  pthread_sigmask(SIG_BLOCK, &handled_signals_, &previous_mask_);
  watcher_ = std::thread([this] { watch(); });
}

Interruption::~Interruption() {
  pthread_kill(watcher_.native_handle(), stop_signal());
  watcher_.join();
  pthread_sigmask(SIG_SETMASK, &previous_mask_, nullptr);
}

void Interruption::watch() const {
  int signal = 0;
  sigwait(&handled_signals_, &signal);
  if (signal == stop_signal()) return;
  stop_flag_ != nullptr ? void(*stop_flag_ = true) : start_finishing(signal);
  do {
    sigwait(&handled_signals_, &signal);
    if (signal == stop_signal() && stop_flag_ != nullptr) return;
  } while (signal == stop_signal());  // ignored: the thread of start_finishing() ends the process
  end_with(signal);
}

void Interruption::start_finishing(int signal) const {
  const auto finish = [this, signal] {
    try {
      finish_();
    } catch (...) {  // ignored: the process ends anyway
    }
    end_with(signal);
  };
  try {
    std::thread(finish).detach();
  } catch (const std::system_error&) {
    finish();  // no thread can be started, so a second signal has no effect
  }
}

}  // namespace pcl_bv::detail
