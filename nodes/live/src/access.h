// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Access control by the HTTP headers Host and Origin. Any page in a browser can open a WebSocket to any
// address, including this machine, but it cannot forge these headers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pcl_bv::live {

struct Address {
  std::string host = "127.0.0.1";
  std::uint16_t port = 0;
};

/// Parses [HOST:]PORT, such as "8765", "localhost:8765", "0.0.0.0:8765" or "[::1]:8765". Port 0 means any
/// free port. Throws std::invalid_argument for any other text.
Address parse_address(const std::string& text);

/// Returns whether a request's header Host ("localhost:8765") can mean this server: a numeric address,
/// localhost, this machine's name (also with ".local") or the host that the server was started with. Other
/// names are refused because of DNS rebinding: a foreign name that resolves to this machine makes a browser
/// treat the foreign page and this server as one site.
bool is_server_host(std::string_view header, const Address& server);

/// Returns whether a page of this origin may connect: the server's own page, a page of this machine, a local
/// file or Foxglove's page. An empty origin may connect: programs that are not browsers send none.
bool may_connect(std::string_view origin, std::string_view host_header);

}  // namespace pcl_bv::live
