// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Threads of our own belong to the process, not to the thread that happened to call first.

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <vector>

#include "child.h"

namespace pcl_bv::detail {
namespace {

struct Attributes {
  cpu_set_t processors;
  int policy;
  int nice;
  sigset_t blocked;
};

Attributes attributes() {
  Attributes here{};
  EXPECT_EQ(::sched_getaffinity(0, sizeof here.processors, &here.processors), 0);
  here.policy = ::sched_getscheduler(0);
  here.nice = ::getpriority(PRIO_PROCESS, 0);
  EXPECT_EQ(::pthread_sigmask(SIG_BLOCK, nullptr, &here.blocked), 0);
  return here;
}

int processors(const Attributes& thread) {
  return CPU_COUNT(&thread.processors);
}

/// Those of the helpers of a call by this thread, before it only waits.
std::vector<Attributes> helpers() {
  std::mutex mutex;
  std::vector<Attributes> all;
  const std::thread::id caller = std::this_thread::get_id();
  const auto ask = [&] {
    if (std::this_thread::get_id() == caller) return;
    const std::lock_guard lock(mutex);
    all.push_back(attributes());
  };
  test::meet(4, ask, [] {});
  EXPECT_EQ(all.size(), 3U);
  return all;
}

void pin_to_one() {
  cpu_set_t set = attributes().processors, one;
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu) {
    if (CPU_ISSET(cpu, &set)) CPU_SET(cpu, &one);
  }
  EXPECT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
}

void become(int policy, int priority) {
  const sched_param parameters{priority};
  ::sched_setscheduler(0, policy, &parameters);
}

TEST(PoolThread, MayUseAllProcessorsOfTheProcessButTheCallersWhereverThatIsPinned) {
  if (processors(attributes()) < 2) GTEST_SKIP() << "this process may use one processor";
  EXPECT_TRUE(test::passes_in_child([] {
    const Attributes main = attributes();
    std::thread([&] {
      pin_to_one();
      cpu_set_t others = attributes().processors;
      CPU_XOR(&others, &main.processors, &others);
      for (const Attributes& helper : helpers())
        EXPECT_TRUE(CPU_EQUAL(&helper.processors, &others));
      EXPECT_EQ(processors(attributes()), 1) << "the caller stays where it is";
    }).join();
  }));
}

TEST(PoolThread, IsBoundToTheProcessorsOfTheMainThread) {
  EXPECT_TRUE(test::passes_in_child([] {
    pin_to_one();
    const Attributes main = attributes();
    for (const Attributes& helper : helpers())
      EXPECT_TRUE(CPU_EQUAL(&helper.processors, &main.processors));
  }));
}

// Their own ones may be taken by others for long.
TEST(PoolThread, MayUseItsCallersProcessorOnceThatOnlyWaits) {
  const int all = processors(attributes());
  if (all < 2) GTEST_SKIP() << "this process may use one processor";
  const std::thread::id caller = std::this_thread::get_id();
  const auto others_only = [&] {
    if (std::this_thread::get_id() != caller) {
      EXPECT_EQ(processors(attributes()), all - 1);
    }
  };
  test::meet(2, others_only, [&] {
    if (std::this_thread::get_id() == caller) return;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (processors(attributes()) < all && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(processors(attributes()), all);
  });
}

TEST(PoolThread, AllMeansTheProcessorsOfTheProcessAndForOpenMpOfTheCaller) {
  const unsigned all = static_cast<unsigned>(processors(attributes()));
  std::thread([&] {
    pin_to_one();
    EXPECT_EQ(thread_count(Threads{}), all);
    EXPECT_EQ(thread_count(Executor{0, [](auto...) {}}), all);
    EXPECT_EQ(thread_count(OpenMP{}), 1U);
  }).join();
}

// The main thread gives way after its child has begun, which anybody may do: so the two differ.
TEST(PoolThread, HasThePolicyAndNiceValueOfTheMainThreadNotOfTheFirstCaller) {
  EXPECT_TRUE(test::passes_in_child([] {
    Attributes main{};
    std::latch changed(1);
    std::thread caller([&] {
      changed.wait();
      for (const Attributes& helper : helpers()) {
        EXPECT_EQ(helper.policy, main.policy);
        EXPECT_EQ(helper.nice, main.nice);
      }
    });
    ::setpriority(PRIO_PROCESS, 0, std::min(19, attributes().nice + 7));
    become(SCHED_IDLE, 0);
    main = attributes();
    EXPECT_EQ(main.policy, SCHED_IDLE);
    changed.count_down();
    caller.join();
  }));
}

// Where the system lets nobody be real-time, nobody is.
TEST(PoolThread, IsNeverRealTime) {
  for (const bool main_too : {false, true}) {
    EXPECT_TRUE(test::passes_in_child([&] {
      if (main_too) become(SCHED_FIFO, 1);
      std::thread([] {
        become(SCHED_RR, 2);
        for (const Attributes& helper : helpers()) {
          EXPECT_NE(helper.policy, SCHED_FIFO);
          EXPECT_NE(helper.policy, SCHED_RR);
        }
      }).join();
    }));
  }
}

TEST(PoolThread, LeavesSignalsToTheHostsThreadsButItsOwnFaults) {
  EXPECT_TRUE(test::passes_in_child([] {
    sigset_t own;
    sigemptyset(&own);
    sigaddset(&own, SIGUSR2);
    EXPECT_EQ(::pthread_sigmask(SIG_SETMASK, &own, nullptr), 0);
    for (const Attributes& helper : helpers()) {
      for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGUSR1, SIGALRM, SIGCHLD, SIGPROF, SIGRTMIN})
        EXPECT_TRUE(sigismember(&helper.blocked, signal)) << signal;
      for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS})
        EXPECT_FALSE(sigismember(&helper.blocked, fault)) << fault;
    }
    const Attributes caller = attributes();
    for (int signal = 1; signal < SIGRTMAX; ++signal)
      EXPECT_EQ(sigismember(&caller.blocked, signal), signal == SIGUSR2) << signal;
  }));
}

// What a body uses may be destroyed next.
TEST(PoolThread, IsWaitedForAtExit) {
  const std::thread::id caller = std::this_thread::get_id();
  const pid_t child = ::fork();
  if (child == 0) {
    test::meet(2, [&] {
      if (std::this_thread::get_id() == caller) std::exit(1);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      ::_exit(0);
    });
  }
  EXPECT_TRUE(test::ends_well(child));
}

}  // namespace
}  // namespace pcl_bv::detail
