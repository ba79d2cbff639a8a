// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Foxglove's WebSocket protocol: formats and parses its messages, without network access.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "stream/middleware.h"

namespace pcl_bv::live {
using namespace detail;

/// Returns the first name in a client's header Sec-WebSocket-Protocol that is foxglove.sdk.v1 or
/// foxglove.websocket.v1. Returns nullopt if there is none.
std::optional<std::string> known_subprotocol(std::string_view offered);

std::string server_info(const std::string& session);
/// Returns the message that advertises the topics with index `first` and above. The index of a topic is the
/// id of its channel.
std::string advertisement(const std::vector<MessageTopic>& topics, std::size_t first);

enum class Level : std::uint8_t { info, warning, error };
std::string status(Level level, const std::string& message);

/// Returns the message with the values of the settings in `names`, or of all settings if `names` is empty.
/// `settings` is the result of RemoteParameters::values(). `id` is the id of the request, or empty.
std::string parameter_values(const std::string& settings, const std::vector<std::string>& names,
                             const std::string& id);

/// The header of a binary message: opcode, subscription id and stamp.
using MessageHeader = std::array<unsigned char, 13>;
MessageHeader message_header(std::uint32_t subscription, std::int64_t stamp_ns);

std::string time_message(std::int64_t stamp_ns);

struct Subscribe {
  std::vector<std::pair<std::uint32_t, std::size_t>>
      subscriptions;  ///< Pairs of subscription id and channel id.
};
struct Unsubscribe {
  std::vector<std::uint32_t> subscriptions;
};
struct GetParameters {
  std::vector<std::string> names;
  std::string id;
};
struct SetParameters {
  std::string object;  ///< The argument of RemoteParameters::change().
  std::vector<std::string> names;
  std::string id;
};
struct WatchParameters {
  bool watch = true;
};
/// An invalid or unsupported request.
struct InvalidRequest {
  std::string why;
};
using Request =
    std::variant<Subscribe, Unsubscribe, GetParameters, SetParameters, WatchParameters, InvalidRequest>;

/// Limits on the parts of a request that an answer repeats. With these limits, no answer is much longer than
/// the values of all settings.
inline constexpr std::size_t kMaxNames = 100;     ///< Of settings, channels or subscriptions.
inline constexpr std::size_t kMaxIdLength = 200;  ///< Bytes of a request's id.

/// Parses a request. Returns InvalidRequest for an invalid request and for a request over the limits.
Request parse_request(const std::string& text);

}  // namespace pcl_bv::live
