// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pool_thread.h"

#include <omp.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <initializer_list>

namespace pcl_bv::detail {
namespace {

// Sets `set` to the processors of the main thread, whose thread id is the process id. Returns false on
// failure, for example on machines with more than 1024 processors, which a cpu_set_t cannot represent.
bool main_thread_processors(cpu_set_t& set) {
  return ::sched_getaffinity(::getpid(), sizeof set, &set) == 0;
}

bool processors_without(int avoided, cpu_set_t& set) {
  if (!main_thread_processors(set)) return false;
  if (avoided >= 0 && CPU_COUNT(&set) > 1) CPU_CLR(static_cast<unsigned>(avoided), &set);
  return CPU_COUNT(&set) > 0;
}

}  // namespace

unsigned process_processors() {
  cpu_set_t set;
  return static_cast<unsigned>(main_thread_processors(set) ? CPU_COUNT(&set) : omp_get_num_procs());
}

int current_processor() {
  return ::sched_getcpu();
}

void avoid_processor(int avoided, std::vector<std::thread>& threads) {
  cpu_set_t set;
  if (!processors_without(avoided, set)) return;
  for (std::thread& thread : threads)
    ::pthread_setaffinity_np(thread.native_handle(), sizeof set, &set);
}

void adopt_main_thread_scheduling(int avoided) {
  cpu_set_t set;
  if (processors_without(avoided, set)) ::sched_setaffinity(0, sizeof set, &set);
  const int policy = ::sched_getscheduler(::getpid()) & ~SCHED_RESET_ON_FORK;
  const bool ordinary = policy == SCHED_BATCH || policy == SCHED_IDLE;
  const sched_param none{};
  ::sched_setscheduler(0, ordinary ? policy : SCHED_OTHER, &none);
  // On Linux each thread has its own nice value; id 0 is the calling thread.
  const id_t main_thread = static_cast<id_t>(::getpid());
  ::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, main_thread));
}

SignalsBlocked::SignalsBlocked() {
  sigset_t all;
  ::sigfillset(&all);
  for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS})
    ::sigdelset(&all, fault);
  ::pthread_sigmask(SIG_SETMASK, &all, &before_);
}

SignalsBlocked::~SignalsBlocked() {
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace pcl_bv::detail
