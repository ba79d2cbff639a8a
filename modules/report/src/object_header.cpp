// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "object_header.h"

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_json.h"

namespace pcl_bv::detail {
namespace {

// Texts of JSON are UTF-8, but names of files have any bytes: each byte becomes a character.
std::string to_json_text(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xc0 | byte >> 6);
      text += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return text;
}

std::string from_json_text(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto first = static_cast<unsigned char>(text[i]);
    const bool pair = (first & 0xfc) == 0xc0 && i + 1 < text.size();
    bytes +=
        pair ? static_cast<char>((first & 3) << 6 | (static_cast<unsigned char>(text[++i]) & 0x3f)) : text[i];
  }
  return bytes;
}

nlohmann::ordered_json json_of(const ObjectInput& input) {
  nlohmann::ordered_json json{
      {"number", input.number}, {"points", input.points}, {"path", to_json_text(input.path)}};
  if (input.recorded) json["recorded"] = *input.recorded;
  return json;
}

ObjectInput input_of(const UntrustedJson& json) {
  ObjectInput input{json.at("number").get<std::size_t>(), json.at("points").get<std::size_t>(),
                    from_json_text(json.at("path").get<std::string>())};
  if (json.contains("recorded")) input.recorded = json.at("recorded").get<std::size_t>();
  return input;
}

std::optional<ObjectInputs> inputs_of(const UntrustedJson& header) {
  if (!header.contains("inputs")) return std::nullopt;
  ObjectInputs inputs{{},
                      header.at("bin_fields").get<std::size_t>(),
                      header.at("columns").get<std::string>(),
                      header.at("topic").get<std::string>()};
  for (const UntrustedJson& input : header.at("inputs"))
    inputs.list.push_back(input_of(input));
  return inputs;
}

}  // namespace

std::string object_header_text(const ObjectFileHeader& header, ScalarType scalar) {
  nlohmann::ordered_json json{{"scalar", scalar == ScalarType::float32 ? "float32" : "float64"},
                              {"nonfinite", header.nonfinite},
                              {"clusters", header.clusters},
                              {"volumes", header.volumes},
                              {"dropped_class", header.dropped_class}};
  if (header.class_value) json["class"] = *header.class_value;
  if (header.ground) {
    json["ground_points"] = header.ground->points;
    json["ground_parts_sum"] = header.ground->check_sum;
  }
  if (header.inputs) {
    json["bin_fields"] = header.inputs->bin_fields;
    json["columns"] = header.inputs->columns;
    json["topic"] = header.inputs->topic;
    json["inputs"] = nlohmann::ordered_json::array();
    for (const ObjectInput& input : header.inputs->list)
      json["inputs"].push_back(json_of(input));
  }
  std::string text = json.dump(-1, ' ', true, UntrustedJson::error_handler_t::replace) + '\n';
  if (text.size() > kMaxObjectHeader) throw IoError("has too many inputs: make more shares");
  return text;
}

ObjectFileHeader parse_object_header(std::string_view content, ScalarType& scalar) {
  try {
    const UntrustedJson json = read_json(content);
    ObjectFileHeader header;
    scalar = json.at("scalar").get<std::string>() == "float64" ? ScalarType::float64 : ScalarType::float32;
    header.nonfinite = json.at("nonfinite").get<std::size_t>();
    header.clusters = json.at("clusters").get<std::string>();
    header.volumes = json.at("volumes").get<std::string>();
    header.dropped_class = json.at("dropped_class").get<std::size_t>();
    header.inputs = inputs_of(json);
    if (json.contains("ground_points"))
      header.ground = {json.at("ground_points").get<std::size_t>(),
                       json.at("ground_parts_sum").get<std::uint64_t>()};
    if (json.contains("class")) header.class_value = json.at("class").get<std::int64_t>();
    return header;
  } catch (const UntrustedJson::exception&) {
    throw IoError("its header cannot be read");
  }
}

}  // namespace pcl_bv::detail
