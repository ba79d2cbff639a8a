// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// isa.cpp is compiled into this program as -DPCL_BV_ISAS="sse4;neon" compiles it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "pcl_bv/points/isa.h"

namespace pcl_bv::detail {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(IsaSubset, OnlyTheCompiledSetsAreUsable) {
  EXPECT_THAT(usable_isas(), AnyOf(ElementsAre(Isa::scalar), ElementsAre(Isa::scalar, Isa::sse4),
                                   ElementsAre(Isa::scalar, Isa::neon)));
}

TEST(IsaSubset, SetsThatAreNotCompiledAreRefused) {
  for (const Isa isa : {Isa::avx2, Isa::avx512, Isa::sve, Isa::sve2}) {
    try {
      UsableIsa{isa};
      ADD_FAILURE() << isa_name(isa);
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr("'" + std::string(isa_name(isa)) + "' is not usable here"));
      EXPECT_THAT(error.what(), AnyOf(EndsWith("(usable: scalar)"), EndsWith("(usable: scalar, sse4)"),
                                      EndsWith("(usable: scalar, neon)")));
    }
  }
}

TEST(IsaSubset, TheDefaultIsTheBestCompiledSet) {
  unsetenv("PCL_BV_ISA");
  EXPECT_EQ(Isa{UsableIsa(Isa::automatic)}, usable_isas().back());
}

}  // namespace
}  // namespace pcl_bv::detail
