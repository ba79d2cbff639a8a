// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Parses untrusted JSON. All JSON from outside must be parsed by these functions. Objects are nlohmann's
// default sorted maps, because ordered_json compares each new key with all previous keys, which takes
// quadratic time.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::detail {

using UntrustedJson = nlohmann::json;

/// Parses the next value, from `at` on, of a text that contains any number of JSON values, and moves `at` to
/// the end of the value. Returns nullopt at the end of the text. Throws IoError for invalid or truncated JSON
/// and for values nested more than kMaxJsonDepth deep.
inline std::optional<UntrustedJson> read_next_json(std::string_view text, std::size_t& at) {
  const std::string_view value = next_json_value(text, at);
  if (value.empty()) return std::nullopt;
  const std::size_t begin = at - value.size();
  try {
    return UntrustedJson::parse(value.begin(), value.end());
  } catch (const UntrustedJson::parse_error& error) {
    if (error.byte > value.size()) throw IoError("truncated JSON: the last value is incomplete");
    throw IoError(position_in(text, begin + error.byte - 1) + ": invalid JSON");
  } catch (const UntrustedJson::exception& error) {  // its message ends with the number in quotes
    std::string_view number = error.what();
    number.remove_prefix(std::min(number.find('\''), number.size() - 1) + 1);
    number = number.substr(0, number.find('\''));
    std::size_t found = value.find(number);
    while (found != std::string_view::npos && found > 0 && value[found - 1] == '"')  // in a name
      found = value.find(number, found + 1);
    throw IoError(position_in(text, begin + std::min(found, value.size())) + ": a number is too large");
  }
}

/// Parses a text that must be exactly one JSON value. Throws IoError for any other text.
inline UntrustedJson read_json(std::string_view text) {
  std::size_t at = 0;
  std::optional<UntrustedJson> value = read_next_json(text, at);
  if (!value) throw IoError("invalid JSON: the text is empty");
  if (!next_json_value(text, at).empty()) throw IoError("invalid JSON: text after the value");
  return *std::move(value);
}

/// Returns the object's member of this name. Throws std::invalid_argument if there is none.
inline const UntrustedJson& member(const UntrustedJson& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (found == object.end()) throw std::invalid_argument(std::string("has no \"") + key + '"');
  return *found;
}

/// Returns a value as text for an error message. The text is the value as JSON, cut to 40 characters. An
/// array or object becomes its number of elements if it has more than 8 elements, or if one of its elements
/// is a string, array or object.
inline std::string abbreviated(const UntrustedJson& value) {
  constexpr std::size_t few = 8;
  const auto is_long = [](const UntrustedJson& part) { return part.is_structured() || part.is_string(); };
  if (value.is_structured() && (value.size() > few || std::any_of(value.begin(), value.end(), is_long))) {
    const std::string size = std::to_string(value.size());
    if (value.is_array()) return "a list of " + size;
    return "an object of " + size + (value.size() == 1 ? " member" : " members");
  }
  if (value.is_string() && value.get_ref<const std::string&>().size() > 40)
    return abbreviated(UntrustedJson(value.get_ref<const std::string&>().substr(0, 40)));
  std::string text = value.dump(-1, ' ', true, UntrustedJson::error_handler_t::replace);
  if (text.size() > 40) text.replace(37, std::string::npos, "...");
  return text;
}

}  // namespace pcl_bv::detail
