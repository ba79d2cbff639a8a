// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "protocol.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pcl_bv/io/read_json.h"
#include "pcl_bv/messages/schema.h"

namespace pcl_bv::live {
using namespace detail;
namespace {

using Json = nlohmann::ordered_json;

// JSON schema of a frame's report. Foxglove needs it to plot the numbers.
constexpr const char* kFrameSchema = R"({"title":"pcl_bv.Frame","type":"object","properties":{
"schema":{"type":"integer"},"seq":{"type":"integer"},"stamp_ns":{"type":"integer"},"frame_id":{"type":"string"},
"file":{"type":"string"},"error":{"type":"string"},"points":{"type":"integer"},
"counts":{"type":"object","additionalProperties":{"type":"integer"}},
"clusters":{"type":"array","items":{"type":"object"}},
"ms":{"type":"object","properties":{"decode":{"type":"number"},"filter":{"type":"number"},"ground":{"type":"number"},
"cluster":{"type":"number"},"fit":{"type":"number"},"track":{"type":"number"},"total":{"type":"number"}}}}})";

template <class AnyJson>
std::string text_of(const AnyJson& json) {
  return json.dump(-1, ' ', false, AnyJson::error_handler_t::replace);
}

using FromClient = UntrustedJson;

struct LimitExceeded {
  const char* why;
};

const FromClient& list_of(const FromClient& request, const char* key) {
  const FromClient& list = request.at(key);
  if (list.size() > kMaxNames)
    throw LimitExceeded{"a request may name at most 100 settings, channels or subscriptions"};
  return list;
}

std::string id_of(const FromClient& request) {
  std::string id = request.value("id", "");
  if (id.size() > kMaxIdLength) throw LimitExceeded{"an id has at most 200 bytes"};
  return id;
}

std::vector<std::string> strings_of(const FromClient& request, const char* key) {
  std::vector<std::string> texts;
  if (!request.contains(key)) return texts;
  for (const FromClient& text : list_of(request, key))
    texts.push_back(text.get<std::string>());
  return texts;
}

Request subscribe(const FromClient& request) {
  Subscribe wanted;
  for (const FromClient& one : list_of(request, "subscriptions"))
    wanted.subscriptions.emplace_back(one.at("id").get<std::uint32_t>(),
                                      one.at("channelId").get<std::size_t>());
  return wanted;
}

Request set_parameters(const FromClient& request) {
  SetParameters wanted;
  FromClient object = FromClient::object();
  for (const FromClient& one : list_of(request, "parameters")) {
    wanted.names.push_back(one.at("name").get<std::string>());
    object[wanted.names.back()] = one.value("value", FromClient("null"));
  }
  wanted.object = text_of(object);
  wanted.id = id_of(request);
  return wanted;
}

Request unsubscribe(const FromClient& request) {
  return Unsubscribe{list_of(request, "subscriptionIds").get<std::vector<std::uint32_t>>()};
}

Request request_of(const FromClient& request) {
  const auto op = request.at("op").get<std::string>();
  if (op == "subscribe") return subscribe(request);
  if (op == "unsubscribe") return unsubscribe(request);
  if (op == "getParameters") return GetParameters{strings_of(request, "parameterNames"), id_of(request)};
  if (op == "setParameters") return set_parameters(request);
  if (op == "subscribeParameterUpdates") return WatchParameters{true};
  if (op == "unsubscribeParameterUpdates") return WatchParameters{false};
  return InvalidRequest{in_quotes(op) + " is not supported here"};
}

}  // namespace

std::optional<std::string> known_subprotocol(std::string_view offered) {
  while (!offered.empty()) {
    std::string_view name = offered.substr(0, offered.find(','));
    offered.remove_prefix(std::min(name.size() + 1, offered.size()));
    while (!name.empty() && name.front() == ' ')
      name.remove_prefix(1);
    while (!name.empty() && name.back() == ' ')
      name.remove_suffix(1);
    if (name == "foxglove.sdk.v1" || name == "foxglove.websocket.v1") return std::string(name);
  }
  return std::nullopt;
}

std::string server_info(const std::string& session) {
  return text_of(Json{{"op", "serverInfo"},
                      {"name", "pcl_bv"},
                      {"capabilities", {"time", "parameters", "parametersSubscribe"}},
                      {"supportedEncodings", Json::array()},
                      {"metadata", Json::object()},
                      {"sessionId", session}});
}

std::string advertisement(const std::vector<MessageTopic>& topics, std::size_t first) {
  Json channels = Json::array();
  for (std::size_t i = first; i < topics.size(); ++i) {
    const bool json = topics[i].encoding == "json";
    channels.push_back({{"id", i},
                        {"topic", topics[i].name},
                        {"encoding", topics[i].encoding},
                        {"schemaName", topics[i].type},
                        {"schema", json ? kFrameSchema : schema_of(topics[i].type)},
                        {"schemaEncoding", json ? "jsonschema" : "ros2msg"}});
  }
  return text_of(Json{{"op", "advertise"}, {"channels", channels}});
}

std::string status(Level level, const std::string& message) {
  return text_of(
      Json{{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message_line(message)}});
}

std::string parameter_values(const std::string& settings, const std::vector<std::string>& names,
                             const std::string& id) {
  Json parameters = Json::array();
  const Json values = Json::parse(settings);
  for (const auto& [name, value] : values.items()) {
    if (!names.empty() && std::find(names.begin(), names.end(), name) == names.end()) continue;
    Json parameter{{"name", name}, {"value", value}};
    if (value.is_number_float()) parameter["type"] = "float64";
    parameters.push_back(std::move(parameter));
  }
  Json json{{"op", "parameterValues"}, {"parameters", std::move(parameters)}};
  if (!id.empty()) json["id"] = id;
  return text_of(json);
}

MessageHeader message_header(std::uint32_t subscription, std::int64_t stamp_ns) {
  MessageHeader header{1};
  for (std::size_t i = 0; i < 4; ++i)
    header[1 + i] = static_cast<unsigned char>(subscription >> (8 * i));
  for (std::size_t i = 0; i < 8; ++i)
    header[5 + i] = static_cast<unsigned char>(static_cast<std::uint64_t>(stamp_ns) >> (8 * i));
  return header;
}

std::string time_message(std::int64_t stamp_ns) {
  const MessageHeader header = message_header(0, stamp_ns);
  return '\2' + std::string(header.begin() + 5, header.end());
}

Request parse_request(const std::string& text) {
  try {
    const FromClient request = read_json(text);
    if (!request.is_object()) return InvalidRequest{"a request must be a JSON object"};
    return request_of(request);
  } catch (const IoError& error) {
    return InvalidRequest{std::string("a request must be a JSON object: ") + error.what()};
  } catch (const LimitExceeded& error) {
    return InvalidRequest{error.why};
  } catch (const FromClient::exception&) {
    return InvalidRequest{"a request lacks a field or has a field of the wrong type"};
  }
}

}  // namespace pcl_bv::live
