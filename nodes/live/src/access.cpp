// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "access.h"

#include <unistd.h>

#include <array>
#include <boost/asio/ip/address.hpp>
#include <charconv>
#include <optional>
#include <stdexcept>

namespace pcl_bv::live {
namespace {

// Returns "localhost" for "localhost:8765", "::1" for "[::1]:8765".
std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    return end == std::string_view::npos ? host : host.substr(1, end - 1);
  }
  return host.substr(0, host.find(':'));
}

// Parses a numeric address. Rejects texts with a zero byte, because Asio would ignore the part after it.
std::optional<boost::asio::ip::address> address_of(std::string_view host) {
  boost::system::error_code error;
  const auto address = boost::asio::ip::make_address(std::string(host), error);
  if (error || host.find('\0') != std::string_view::npos) return std::nullopt;
  return address;
}

bool is_loopback_host(std::string_view host) {
  const auto address = address_of(host);
  return host == "localhost" || (address && address->is_loopback());
}

}  // namespace

Address parse_address(const std::string& text) {
  Address address;
  const std::size_t colon = text.rfind(':');
  const std::string_view port = std::string_view(text).substr(colon == std::string::npos ? 0 : colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (colon != std::string::npos) address.host = without_port(text.substr(0, colon));
  if (error != std::errc() || end != port.data() + port.size() || address.host.empty())
    throw std::invalid_argument("'" + text + "' is not [HOST:]PORT with a port from 0 to 65535");
  return address;
}

bool is_server_host(std::string_view header, const Address& server) {
  const std::string_view host = without_port(header);
  std::array<char, 256> name{};
  const bool named = gethostname(name.data(), name.size() - 1) == 0;
  return address_of(host) || host == "localhost" || host == server.host ||
         (named && (host == name.data() || host == std::string(name.data()) + ".local"));
}

bool may_connect(std::string_view origin, std::string_view host_header) {
  if (origin.empty() || origin == "file://" || origin == "https://app.foxglove.dev") return true;
  const std::size_t scheme = origin.find("://");
  if (scheme == std::string_view::npos) return false;  // such as "null", the origin of a sandboxed page
  const std::string_view from = origin.substr(scheme + 3);
  return from == host_header || is_loopback_host(without_port(from));
}

}  // namespace pcl_bv::live
