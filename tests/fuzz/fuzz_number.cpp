// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any text as a number: the quick way gives what std::from_chars gives, to the bit, or nothing.
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "short_decimal.h"

namespace {

template <typename T>
void check(const std::string& text, std::size_t size) {
  T quick, expected;
  const char* after = pcl_bv::detail::read_short_decimal(text.data(), quick);
  if (!after) return;
  const auto [end, error] = std::from_chars(text.data() + (text[0] == '+'), text.data() + size, expected);
  if (error != std::errc() || end != after || std::memcmp(&quick, &expected, sizeof quick) != 0) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  text.append(pcl_bv::detail::kTextPadding, '\n');
  check<float>(text, size);
  check<double>(text, size);
  return 0;
}
