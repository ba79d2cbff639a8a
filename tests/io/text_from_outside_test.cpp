// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <functional>

#include "pcl_bv/io/untrusted_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files.h"
#include "pcl_bv/io/read_json.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& json) {
  try {
    static_cast<void>(read_json(json));
  } catch (const IoError& error) {
    return error.what();
  }
  return "no error";
}

std::string nested(int depth, const std::string& open = "[", const std::string& close = "]") {
  std::string text;
  for (int i = 0; i < depth; ++i)
    text += open;
  for (int i = 0; i < depth; ++i)
    text += close;
  return text;
}

TEST(TextFromOutside, ValuesOfJsonComeOneAfterAnother) {
  const std::string text = " {\"a]\":[1,\"}\\\"\"]}\n[]7 \"x\"true\n";
  std::vector<std::string> values;
  std::size_t at = 0;
  for (;;) {
    const std::string_view value = next_json_value(text, at);
    if (value.empty()) break;
    values.emplace_back(value);
  }
  EXPECT_THAT(values, testing::ElementsAre("{\"a]\":[1,\"}\\\"\"]}", "[]", "7", "\"x\"", "true"));
  EXPECT_EQ(at, text.size());
}

TEST(TextFromOutside, DepthEndsWhereItShouldWhateverFollows) {
  EXPECT_EQ(read_json(nested(kMaxJsonDepth)).size(), 1U);
  for (const int depth : {kMaxJsonDepth + 1, 20'000, 100'000}) {
    EXPECT_EQ(error_of(nested(depth)), "line 1, column 65: nested more than 64 deep");
    EXPECT_EQ(error_of(std::string(static_cast<std::size_t>(depth), '[')),
              "line 1, column 65: nested more than 64 deep");
    EXPECT_EQ(error_of(nested(depth, "{\"a\":", "}")), "line 1, column 321: nested more than 64 deep");
  }
  EXPECT_EQ(read_json("[" + std::string("\"") + std::string(1000, '[') + "\"]").size(), 1U);
}

TEST(TextFromOutside, IsPrintableWithoutControlCharacters) {
  EXPECT_EQ(printable(std::string("a\0b\nc\x1f d\x7f~", 10)), "a?b?c? d?~");
  EXPECT_EQ(printable("gr\u00f6\u00dfe"), "gr\u00f6\u00dfe");
}

TEST(TextFromOutside, WhatIsNoJsonHasItsPlaceInOurWords) {
  EXPECT_EQ(error_of("{\n \"a\": nope}"), "line 2, column 8: invalid JSON");
  EXPECT_EQ(error_of("[1, 2"), "truncated JSON: the last value is incomplete");
  EXPECT_EQ(error_of("{\"a"), "truncated JSON: the last value is incomplete");
  EXPECT_EQ(error_of("[1e999]"), "line 1, column 2: a number is too large");
  EXPECT_EQ(error_of("  "), "invalid JSON: the text is empty");
  EXPECT_EQ(error_of("1 2"), "invalid JSON: text after the value");
  for (const char* text :
       {"]", "}", "[}", "{]", "\xff", "[\"\xff\"]", "\"\\u12\"", "{1:2}", "[1,]", ",", "[1 2]"})
    EXPECT_THAT(error_of(text), testing::Not(HasSubstr("exception"))) << text;
}

// Keys in the order of the text would be compared with all before them: 10^5 of them took minutes.
TEST(TextFromOutside, ManyKeysAreReadIntoAMap) {
  std::string text = "{";
  for (int i = 0; i < 100'000; ++i)
    text += (i == 0 ? "\"" : ",\"") + std::to_string(i) + "\":0";
  EXPECT_EQ(read_json(text + "}").size(), 100'000U);
  static_assert(std::is_same_v<UntrustedJson::object_t::key_compare, std::less<>>);
}

using FilesFromOutside = FileTest;

TEST_F(FilesFromOutside, AreReadNoFartherThanTheyMayGo) {
  const std::filesystem::path small = file("text");
  write_text(small, std::string(1000, 'x'));
  EXPECT_EQ(read_untrusted_text(small, 1000).size(), 1000U);
  const auto error_of_file = [](const std::filesystem::path& path, std::size_t most) -> std::string {
    try {
      static_cast<void>(read_untrusted_text(path, most));
    } catch (const IoError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of_file(small, 999), "has more than 999 bytes");
  EXPECT_EQ(error_of_file("/dev/zero", 100'000), "has more than 100000 bytes");
  EXPECT_EQ(error_of_file("/no/such/file", 1), "no such file or directory");
  EXPECT_EQ(error_of_file("/tmp", 1), "is a directory");
  EXPECT_EQ(read_untrusted_text("/dev/null", 1), "");
}

TEST(TextFromOutside, MessagesKeepBothEndsOfLongNamesAndOfTheLine) {
  EXPECT_EQ(message_line("a.pcd: no such file"), "a.pcd: no such file");
  EXPECT_EQ(message_line("a\nb\x1b[2J"), "a?b?[2J");
  const std::string name = "begin" + std::string(200'000, 'x') + "end.glb",
                    line = message_line("dir/t.json: " + name + ": no such file");
  EXPECT_LE(line.size(), 12 + kMaxNameBytes + 14);
  EXPECT_THAT(line, testing::StartsWith("dir/t.json: beginxxx"));
  EXPECT_THAT(line, testing::EndsWith("xxxend.glb: no such file"));
  std::string words;
  for (int i = 0; i < 60'000; ++i)
    words += "/topic" + std::to_string(i) + ", ";
  const std::string list = message_line("topics: " + words + "choose one");
  EXPECT_LE(list.size(), kMaxMessageBytes);
  EXPECT_THAT(list, testing::StartsWith("topics: /topic0, /topic1, "));
  EXPECT_THAT(list, testing::EndsWith(", /topic59999, choose one"));
}

TEST(TextFromOutside, MessagesKeepTheCharactersOfUtf8Whole) {
  for (const std::string character : {"\xC3\xA4", "\xE2\x82\xAC", "\xF0\x9F\x98\x80"}) {
    for (std::size_t shift = 0; shift < 4; ++shift) {
      std::string name(shift, 'a');
      while (name.size() < 1000)
        name += character;
      std::string line = message_line(name);
      EXPECT_LE(line.size(), kMaxNameBytes);
      line.erase(line.find("..."), 3);
      EXPECT_EQ((line.size() - shift) % character.size(), 0U) << line;
    }
  }
  EXPECT_LE(message_line(std::string(1000, '\x80')).size(), kMaxNameBytes);
}

TEST(TextFromOutside, ListsOfNamesEndWithANumber) {
  EXPECT_EQ(name_list({}), "");
  EXPECT_EQ(name_list({"a", "b"}), "a, b");
  EXPECT_EQ(name_list({"1", "2", "3", "4", "5", "6", "7", "8", "9", "10"}),
            "1, 2, 3, 4, 5, 6, 7, 8 and 2 more");
}

TEST(TextFromOutside, AFailedAllocationHasAReason) {
  EXPECT_EQ(reason_of(std::bad_alloc()), "not enough memory");
  EXPECT_EQ(reason_of(std::length_error("vector::_M_default_append")), "not enough memory");
  EXPECT_EQ(reason_of(std::length_error("cannot create std::vector larger than max_size()")),
            "not enough memory");
  EXPECT_EQ(reason_of(std::length_error("too many clusters in a share: use more shares")),
            "too many clusters in a share: use more shares");
  EXPECT_EQ(reason_of(IoError("is cut")), "is cut");
}

}  // namespace
}  // namespace pcl_bv::detail
