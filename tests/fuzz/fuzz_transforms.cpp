// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as messages with transforms. The first byte of each message tells its kind, the second one its
// length. Whatever was added, a transform that is found is rigid, and its inverse is found, too.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>

#include "pcl_bv/messages/serialize.h"
#include "stream/rig/transform_feed.h"

namespace {

using namespace pcl_bv;
using namespace pcl_bv::detail;

constexpr const char* kFrames[] = {"base", "front", "odom", "b"};

void check(const Transforms& transforms, const char* target, const char* source, std::int64_t stamp) {
  const FoundTransform there = transforms.find(target, source, stamp),
                       back = transforms.find(source, target, stamp);
  if (there.pose.has_value() != back.pose.has_value() || there.pose.has_value() != there.problem.empty())
    std::abort();
  if (!there.pose) return;
  const Eigen::Matrix3d rotation = there.pose->linear();
  if (!(rotation * rotation.transpose()).isIdentity(1e-9) || !(rotation.determinant() > 0)) std::abort();
  if (!there.pose->translation().allFinite()) std::abort();
}

// Each pair once: find() is asked in both directions, and most of the fuzzer's time is spent here.
void check_pairs(const Transforms& transforms, std::int64_t stamp) {
  for (std::size_t i = 0; i < std::size(kFrames); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      check(transforms, kFrames[i], kFrames[k], stamp);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Transforms transforms;
  while (size > 2) {
    const std::size_t length = std::min<std::size_t>(data[1], size - 2);
    try {
      add_transforms({reinterpret_cast<const std::byte*>(data + 2), length, (data[0] & 1) != 0,
                      (data[0] & 2) != 0, (data[0] & 4) != 0},
                     transforms);
    } catch (const MessageError&) {
    }
    data += 2 + length;
    size -= 2 + length;
  }
  for (const std::int64_t stamp : {0LL, 150'000'000LL, 1'700'000'000'000'000'000LL})
    check_pairs(transforms, stamp);
  if (transforms.take_warnings().size() > size + 10'000) std::abort();
  return 0;
}
