// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A forked child has the memory of its parent's pool, but none of its threads.

#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "child.h"

namespace pcl_bv::detail {
namespace {

// More threads than any other test asks for, so that a child wants more than its parent has.
constexpr unsigned kMore = 12;

void nothing() {}

TEST(Fork, AChildMayAskForMoreThreadsThanItsParentHad) {
  test::meet(2, nothing);
  for (int i = 0; i < 40; ++i)
    ASSERT_TRUE(test::passes_in_child([] { test::meet(kMore, nothing); })) << "child " << i;
}

TEST(Fork, AChildAndAGrandchildHaveThreadsLikeAnyProcess) {
  test::meet(3, nothing);
  EXPECT_TRUE(test::passes_in_child([] {
    test::meet(3, nothing);
    EXPECT_TRUE(test::passes_in_child([] { test::meet(4, nothing); }));
    test::meet(3, nothing);
  }));
  test::meet(3, nothing);
}

// The pool's lock is then often held by a thread that the child does not have.
// Locks that other threads hold at a fork stay locked in the child: the C library frees its own,
// AddressSanitizer's allocator of g++ 12 and qemu do not, and the child hangs in theirs.
#if !defined(__SANITIZE_ADDRESS__) && !defined(PCL_BV_EMULATED)
TEST(Fork, WhileOtherThreadsWorkTheChildStillWorksWithThreads) {
  std::atomic<bool> enough{false};
  std::atomic<std::size_t> calls{0};
  const auto work = [&] {
    while (!enough)
      for_each_chunk(Threads{3}, 4, [&](std::size_t) { ++calls; });
  };
  std::jthread one(work), other(work);
  for (int i = 0; i < 100 && !testing::Test::HasFailure(); ++i)
    EXPECT_TRUE(test::passes_in_child([] { test::meet(4, nothing); })) << "child " << i;
  enough = true;
  EXPECT_GT(calls, 0U);
}
#endif

TEST(Fork, WhileThreadsAreAwakeTheChildHasItsOwnOnes) {
  EXPECT_TRUE(test::passes_in_child([] {
    const SpinningThreads awake(Threads{3});
    test::meet(3, nothing);
    EXPECT_TRUE(test::passes_in_child([] {
      test::meet(4, nothing);
      const SpinningThreads own(Threads{2});
      test::meet(2, nothing);
    }));
    test::meet(3, nothing);
  }));
  const SpinningThreads awake(Threads{3});
  test::meet(3, nothing);  // threads that are still being started may hold locks of AddressSanitizer
  if (const pid_t child = ::fork(); child != 0) {
    EXPECT_TRUE(test::ends_well(child));
  } else {
    ::alarm(30);
    test::meet(3, nothing);
    awake.~SpinningThreads();  // of a pool that is its parent's
    test::meet(3, nothing);
    ::_exit(0);
  }
}

TEST(Fork, InsideABodyTheChildIsInsideNoCall) {
  std::atomic<int> good{0};
  test::meet(2, [&] { good += test::passes_in_child([] { test::meet(3, nothing); }) ? 1 : 0; });
  EXPECT_EQ(good, 2);
}

// At exit a pool's threads are joined: not the parent's, which the child has not.
TEST(Fork, AChildExitsWhetherItHadThreadsOfItsOwnOrNot) {
  test::meet(3, nothing);
  for (const unsigned threads : {0U, 4U}) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::alarm(test::kHangs);
      test::meet(threads, nothing);
      std::exit(0);
    }
    EXPECT_TRUE(test::ends_well(child)) << threads;
  }
}

// Of the caller: an error. A helper has no caller in the child: its thread ends, and the child as the last
// one.
TEST(Fork, AChildThatReturnsFromABodyDoesNotHang) {
  const pid_t parent = ::getpid();
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<pid_t> of_caller{0}, of_helper{0};
  bool refused = false;
  try {
    test::meet(2, [&] {
      const pid_t child = ::fork();
      if (child == 0) ::alarm(test::kHangs);
      (std::this_thread::get_id() == caller ? of_caller : of_helper) = child;
    });
  } catch (const std::logic_error&) {
    refused = true;
  }
  if (::getpid() != parent) ::_exit(refused ? 0 : 1);
  EXPECT_FALSE(refused);
  EXPECT_TRUE(test::ends_well(of_caller));
  int status = 0;
  EXPECT_EQ(::waitpid(of_helper, &status, 0), of_helper);
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
}

}  // namespace
}  // namespace pcl_bv::detail
