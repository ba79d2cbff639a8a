// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/points/isa.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace pcl_bv::detail {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

// Sets PCL_BV_ISA and puts back what was there.
class Environment {
 public:
  explicit Environment(const char* value) {
    if (const char* old = std::getenv("PCL_BV_ISA")) old_ = old;
    value == nullptr ? unsetenv("PCL_BV_ISA") : setenv("PCL_BV_ISA", value, 1);
  }
  ~Environment() { old_ ? setenv("PCL_BV_ISA", old_->c_str(), 1) : unsetenv("PCL_BV_ISA"); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::optional<std::string> old_;
};

std::string error_of(const auto& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Isa, EveryNameParsesBackToItsSet) {
  for (const Isa isa :
       {Isa::automatic, Isa::scalar, Isa::sse4, Isa::avx2, Isa::avx512, Isa::neon, Isa::sve, Isa::sve2}) {
    EXPECT_EQ(parse_isa(isa_name(isa)), isa) << isa_name(isa);
  }
}

TEST(Isa, UnknownNamesAreErrorsThatListTheKnownOnes) {
  for (const char* name : {"", "AVX2", "avx", "sse", "best", "avx512 "}) {
    EXPECT_THAT(error_of([&] { parse_isa(name); }),
                HasSubstr("unknown instruction set '" + std::string(name) + "'"));
  }
  EXPECT_THAT(error_of([] { parse_isa("foo"); }),
              HasSubstr("auto, scalar, sse4, avx2, avx512, neon, sve, sve2"));
}

TEST(Isa, ScalarIsAlwaysUsableAndFirst) {
  EXPECT_EQ(usable_isas().front(), Isa::scalar);
}

#if defined(__x86_64__)
TEST(Isa, ThisBuildHasSimdKernelsForThisProcessor) {
  if (!__builtin_cpu_supports("sse4.2")) GTEST_SKIP() << "a processor without SSE4";
  EXPECT_THAT(usable_isas(), Contains(Isa::sse4));
  EXPECT_EQ(__builtin_cpu_supports("avx512bw") != 0, usable_isas().back() == Isa::avx512);
}

TEST(Isa, SetsAreThoseThatHighwayFinds) {
  const auto found = hwy::SupportedTargets();
  for (const auto& [isa, target] :
       {std::pair{Isa::sse4, HWY_SSE4}, {Isa::avx2, HWY_AVX2}, {Isa::avx512, HWY_AVX3}}) {
    EXPECT_EQ(testing::Value(usable_isas(), Contains(isa)), (found & target) != 0) << isa_name(isa);
  }
}

TEST(Isa, SetsOfOtherProcessorsAreErrorsThatListTheUsableOnes) {
  EXPECT_THAT(error_of([] { UsableIsa{Isa::neon}; }), HasSubstr("'neon' is not usable here (usable: scalar"));
}
#endif

TEST(Isa, AutomaticIsTheBestUsableSet) {
  const Environment environment(nullptr);
  const std::vector<Isa> usable = usable_isas();
  const bool arm = std::find(usable.begin(), usable.end(), Isa::neon) != usable.end();
  EXPECT_EQ(Isa{UsableIsa()}, arm ? Isa::neon : usable.back());
}

TEST(Isa, AutomaticObeysTheEnvironment) {
  for (const Isa isa : usable_isas()) {
    const Environment environment(std::string(isa_name(isa)).c_str());
    EXPECT_EQ(Isa{UsableIsa()}, isa);
  }
}

TEST(Isa, ACopyKeepsItsSetWhateverTheEnvironmentSaysByThen) {
  const Environment environment("scalar");
  const UsableIsa scalar;
  setenv("PCL_BV_ISA", "foo", 1);
  const UsableIsa copy = scalar;
  EXPECT_EQ(Isa{copy}, Isa::scalar);
}

TEST(Isa, WhatIsNoSetAtAllIsAnError) {
  EXPECT_THAT(error_of([] { UsableIsa{static_cast<Isa>(8)}; }), HasSubstr("'unknown' is not usable here"));
}

TEST(Isa, AnExplicitSetOverridesTheEnvironment) {
  const Environment environment("foo");
  EXPECT_EQ(Isa{UsableIsa(Isa::scalar)}, Isa::scalar);
}

TEST(Isa, AnUnknownNameInTheEnvironmentIsAnError) {
  const Environment environment("foo");
  EXPECT_THAT(error_of([] { UsableIsa(); }), HasSubstr("unknown instruction set 'foo'"));
}

TEST(Isa, AnUnusableSetInTheEnvironmentIsAnError) {
#if defined(__x86_64__)
  const Environment environment("sve2");
#else
  const Environment environment("avx2");
#endif
  EXPECT_THAT(error_of([] { UsableIsa(); }), HasSubstr("is not usable here"));
}

}  // namespace
}  // namespace pcl_bv::detail
