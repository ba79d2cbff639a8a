// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The only way in for JSON that somebody else wrote. nlohmann's objects are maps here: with keys in the order
// of the text each new key would be compared with all before it.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "pcl_bv/io/text_from_outside.h"

namespace pcl_bv {

using JsonFromOutside = nlohmann::json;

/// The next value of a text of any number of them; nothing at its end. Throws IoError, which names line and
/// column, for what is no JSON and for values nested more than kMaxJsonDepth deep.
inline std::optional<JsonFromOutside> read_next_json(std::string_view text, std::size_t& at) {
  const std::string_view value = next_json_value(text, at);
  if (value.empty()) return std::nullopt;
  const std::size_t begin = at - value.size();
  try {
    return JsonFromOutside::parse(value.begin(), value.end());
  } catch (const JsonFromOutside::parse_error& error) {
    if (error.byte > value.size()) throw IoError("is cut off: the last value has no end");
    throw IoError(position_in(text, begin + error.byte - 1) + ": is no JSON");
  } catch (const JsonFromOutside::exception&) {
    throw IoError(position_in(text, begin) + ": a number is too large");
  }
}

/// A text that is one value.
inline JsonFromOutside read_json(std::string_view text) {
  std::size_t at = 0;
  std::optional<JsonFromOutside> value = read_next_json(text, at);
  if (!value) throw IoError("is no JSON: it is empty");
  if (!next_json_value(text, at).empty()) throw IoError("is no JSON: something follows the value");
  return *std::move(value);
}

/// The member of this name. Throws std::invalid_argument where there is none.
inline const JsonFromOutside& member(const JsonFromOutside& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (found == object.end()) throw std::invalid_argument(std::string("has no \"") + key + '"');
  return *found;
}

/// A value in a message: its first 40 characters, of a long list or group only its length.
inline std::string shown(const JsonFromOutside& value) {
  constexpr std::size_t few = 8;
  const auto is_long = [](const JsonFromOutside& part) { return part.is_structured() || part.is_string(); };
  if (value.is_structured() && (value.size() > few || std::any_of(value.begin(), value.end(), is_long)))
    return (value.is_array() ? "a list of " : "a group of ") + std::to_string(value.size());
  if (value.is_string() && value.get_ref<const std::string&>().size() > 40)
    return shown(JsonFromOutside(value.get_ref<const std::string&>().substr(0, 40)));
  std::string text = value.dump(-1, ' ', true, JsonFromOutside::error_handler_t::replace);
  if (text.size() > 40) text.replace(37, std::string::npos, "...");
  return text;
}

}  // namespace pcl_bv
