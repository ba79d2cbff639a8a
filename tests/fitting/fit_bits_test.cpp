// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The bits of every method's volumes, as one number each: whoever changes a result sees it here, meant or
// not.

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "numbers.h"
#include "pcl_bv/fitting/methods.h"
#include "portable_clouds.h"

namespace pcl_bv {
namespace {

struct Stated {
  std::string_view method;
  std::uint64_t of_float, of_double;
};

void PrintTo(const Stated& stated, std::ostream* out) {
  *out << stated.method;
}

// After a change that is meant: what the test says.
constexpr Stated kStated[] = {
    {"aabb", 0x678578ce7e96ca21, 0x60bfe28571181524},
    {"dop6", 0x286c02a3be96ca21, 0x2f7d461478898c7e},
    {"dop14", 0x3ec1e9ab257de281, 0xfc4f901608a7a082},
    {"dop18", 0x621135da1dd3016b, 0x6ba742f96cfaa1a8},
    {"dop26", 0xc9dd8c1e6f20754b, 0xbac4a2a4f07ae6e0},
    {"sphere-ritter", 0x6d6d2a4a87b07d55, 0xdc5d3dab1bece440},
    {"sphere-epos6", 0x80c664f4a356cba0, 0x292162d6b12e698e},
    {"sphere-epos14", 0xe88dd9a333ac557e, 0xd5a45e5a02b0a1cf},
    {"sphere-epos26", 0xcdf159ab87d77b3c, 0xdf1d919df4de4e15},
    {"sphere-epos98", 0x41ca445df02deaa8, 0xe4f33fa3041ed7df},
    {"sphere-exact", 0x2426dac2d69dcbfe, 0x102931c81c89b1e3},
    {"obb-pca", 0x137628a9ae5a9d65, 0xe79f07f8099510f4},
    {"obb-dito14", 0xa10ec6f953e55e5d, 0xec9a8fb989ac42c7},
    {"obb-min", 0xff4b86ff05cf7ace, 0xb03ad462417ae9a3},
    {"obb-yaw", 0x19f33a05fad7482d, 0x3066bad8bc3adb06},
    {"obb-lshape", 0x6ca7da3781023281, 0x78b7bd19c12e63c1},
    {"cylinder", 0xa153257a0f00da71, 0xc7d5353c0fd9b856},
    {"capsule", 0x6ce972f889a09006, 0xb015301c4c0bbb0e},
    {"ellipsoid", 0xe9d4e5a68f5f9d6f, 0xb3a81b6256e6f819},
    {"hull", 0xd18ddc5d194813a, 0x7e4c9828bd0186b0},
    {"best", 0xb3a2ce823a7a61bd, 0x971dd97d4a833bca},
};

// FNV-1a, by words.
class Digest {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001B3; }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325;
};

// All that the method heeds.
std::vector<MethodOptions> options_of(const Method& method) {
  if (method.shape == "sphere") {
    return {{SphereGrowth::deferred, Eigen::Vector3d::UnitZ()},
            {SphereGrowth::sequential, Eigen::Vector3d::UnitZ()},
            {SphereGrowth::stationary, Eigen::Vector3d::UnitZ()}};
  }
  if (method.upright) return {{}, {SphereGrowth::deferred, {1, -2, 3}}};
  return {{}};
}

template <typename T>
std::uint64_t digest(const Method& method) {
  Digest digest;
  for (const test::TestCloud<T>& cloud : test::portable_clouds<T>()) {
    for (const MethodOptions& options : options_of(method)) {
      AnyVolume volume;
      const EstimationResult result = method.fit(cloud.view(), volume, {}, options);
      for (const int number : {static_cast<int>(result.status), result.rank, static_cast<int>(result.used)})
        digest.add(static_cast<std::uint64_t>(number));
      for (const std::uint64_t number : test::bits(volume))
        digest.add(number);
    }
  }
  return digest.value();
}

class FitBits : public testing::TestWithParam<Stated> {};

TEST_P(FitBits, AreThoseStated) {
  const Method* method = find_method(GetParam().method);
  ASSERT_NE(method, nullptr);
  const std::uint64_t of_float = digest<float>(*method), of_double = digest<double>(*method);
  EXPECT_TRUE(of_float == GetParam().of_float && of_double == GetParam().of_double)
      << "now {\"" << method->name << "\", 0x" << std::hex << of_float << ", 0x" << of_double << "},";
}

INSTANTIATE_TEST_SUITE_P(OfAMethod, FitBits, testing::ValuesIn(kStated), [](const auto& info) {
  std::string name(info.param.method);
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

TEST(FitBitsOfAllMethods, AreStated) {
  for (const Method& method : methods()) {
    bool stated = false;
    for (const Stated& s : kStated)
      stated = stated || s.method == method.name;
    EXPECT_TRUE(stated) << method.name;
  }
}

}  // namespace
}  // namespace pcl_bv
