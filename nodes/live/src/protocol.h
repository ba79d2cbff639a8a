// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Foxglove's WebSocket protocol: what is said, without a network.
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

/// The first of a client's subprotocols, as its header lists them, that is one of the protocol's two names.
std::optional<std::string> known_subprotocol(std::string_view offered);

std::string server_info(const std::string& session);
/// Of topics by their numbers, which are those of their channels.
std::string advertisement(const std::vector<MessageTopic>& topics, std::size_t first);

enum class Level : std::uint8_t { info, warning, error };
std::string status(Level level, const std::string& message);

/// Of settings by key (RemoteSettings::values()), those that are asked for, or all if none are; `id` of the
/// request.
std::string parameter_values(const std::string& settings, const std::vector<std::string>& names,
                             const std::string& id);

/// What comes before the bytes of a message.
using MessageHead = std::array<unsigned char, 13>;
MessageHead message_head(std::uint32_t subscription, std::int64_t stamp_ns);

std::string time_message(std::int64_t stamp_ns);

struct Subscribe {
  std::vector<std::pair<std::uint32_t, std::size_t>>
      subscriptions;  ///< Their numbers, and those of the channels.
};
struct Unsubscribe {
  std::vector<std::uint32_t> subscriptions;
};
struct GetParameters {
  std::vector<std::string> names;
  std::string id;
};
struct SetParameters {
  std::string object;  ///< As RemoteSettings::change() takes it.
  std::vector<std::string> names;
  std::string id;
};
struct WatchParameters {
  bool watch = true;
};
struct Unknown {
  std::string why;
};
using Request = std::variant<Subscribe, Unsubscribe, GetParameters, SetParameters, WatchParameters, Unknown>;

/// What one request may name, and how much of it comes back in answers: an answer is never much longer than
/// the settings' values, whatever was asked.
inline constexpr std::size_t kMaxNames = 100;     ///< Settings, channels or subscriptions; there are some 30.
inline constexpr std::size_t kMaxIdLength = 200;  ///< Bytes.
inline constexpr std::size_t kMaxStatusLength = 500;  ///< Bytes of a status' message.

/// Any text: what makes no sense, or names too much, is Unknown.
Request parse_request(const std::string& text);

}  // namespace pcl_bv::live
