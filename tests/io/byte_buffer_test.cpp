// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A vector like any other, except for what is in it at first.
#include "pcl_bv/io/raw_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <new>

namespace pcl_bv::detail {
namespace {

ByteBuffer filled(std::size_t size) {
  ByteBuffer buffer(size);
  for (std::size_t i = 0; i < size; ++i)
    buffer[i] = static_cast<std::byte>(i * 7 + i / 251);
  return buffer;
}

constexpr std::size_t large = std::size_t{5} << 20;

TEST(ByteBuffer, KeepsItsBytesWhenItGrowsAndIsCopied) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1000}, large}) {
    const ByteBuffer expected = filled(size);
    ByteBuffer buffer = expected;
    EXPECT_EQ(buffer, expected);
    buffer.resize(size + large);
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), buffer.begin()));
  }
}

TEST(ByteBuffer, TakesAValueWhereOneIsGiven) {
  EXPECT_EQ(ByteBuffer(3, std::byte{9}), (ByteBuffer{std::byte{9}, std::byte{9}, std::byte{9}}));
}

TEST(ByteBuffer, OfManyBytesBeginsAtAHugePage) {
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(ByteBuffer(large).data()) % (2 << 20), 0u);
}

TEST(ByteBuffer, OfMoreThanThereIsThrows) {
  EXPECT_THROW(BufferAllocator<double>().allocate(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they end the process
  EXPECT_THROW(BufferAllocator<std::byte>().allocate(static_cast<std::size_t>(-1) / 2 - 100), std::bad_alloc);
#endif
}

}  // namespace
}  // namespace pcl_bv::detail
