// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The manual pages say what the programs do: the same options, methods and sections.

#include <gmock/gmock.h>

#include <regex>
#include <set>
#include <sstream>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

/// A page as its reader sees the words: no escapes, fonts or quotation marks.
std::string page(const std::string& command) {
  const std::string text = read_file(PCL_BV_MANUAL "/" + command + ".1");
  return std::regex_replace(text, std::regex(R"(\\(-)|\\&|")"), "$1");
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  std::set<std::string> found;
  const std::regex regex(pattern, std::regex::ECMAScript | std::regex::multiline);
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    found.insert((*it)[1]);
  return found;
}

class Manual : public PcdBv, public testing::WithParamInterface<std::string> {
 protected:
  std::string help() const { return run({"--help"}, {.program = GetParam()}).out; }
};

TEST_P(Manual, HasTheOptionsOfTheHelpWithTheirArguments) {
  // "  --volume LIST      Methods ..." and ".BI --volume LIST"; "-h,--help" has a space more in the page
  const std::set<std::string> helped = matches(help(), "^ +(?:-h,)?(--[a-z-]+(?: [A-Z][A-Za-z.:,/]*)?)");
  const std::set<std::string> paged =
      matches(page(GetParam()), "^\\.TP\n\\.BI? (?:-h, )?(--[a-z-]+(?: +[A-Z][A-Za-z.:,/]*)?)$");
  EXPECT_GT(helped.size(), 20U);
  std::set<std::string> words;
  for (const std::string& option : paged)
    words.insert(std::regex_replace(option, std::regex(" +"), " "));
  EXPECT_EQ(words, helped);
}

TEST_P(Manual, HasEverySectionThatReadersLookFor) {
  for (const char* section : {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "METHODS", "OUTPUT",
                              "EXIT STATUS", "ENVIRONMENT", "EXAMPLES", "SEE ALSO"}) {
    EXPECT_THAT(page(GetParam()), HasSubstr(std::string("\n.SH ") + section + "\n"));
  }
}

TEST_P(Manual, RendersWithoutAWarning) {
  if (!std::filesystem::exists("/usr/bin/groff")) GTEST_SKIP() << "no groff here";
  const Result result = run({"-t", "-man", "-Tutf8", "-ww", PCL_BV_MANUAL "/" + GetParam() + ".1"},
                            {.program = "/usr/bin/groff"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_GT(result.out.size(), 1000U);
}

INSTANTIATE_TEST_SUITE_P(EveryCommand, Manual, testing::Values("pcd_bv", "bv_stream"),
                         [](const auto& test) { return test.param; });

TEST_F(PcdBv, ManualNamesEveryMethod) {
  const std::string known = run({"--volume", "?", "x"}).err;
  std::istringstream names(known.substr(known.find("known are ") + 10));
  const std::string manual = page("pcd_bv");
  int n = 0;
  for (std::string name; names >> name; ++n) {
    if (name.back() == ',') name.pop_back();
    EXPECT_TRUE(std::regex_search(manual, std::regex("(^|[\n ])" + name + "[ @.\n]"))) << name;
  }
  EXPECT_GT(n, 20);
}

}  // namespace
}  // namespace pcl_bv::test
