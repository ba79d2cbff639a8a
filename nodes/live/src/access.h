// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Access control by the HTTP headers Host and Origin. Any page in a browser can open a WebSocket to any
// address, including addresses of this machine. The page cannot forge these two headers.
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

/// Returns whether a request's header Host, such as "localhost:8765", can mean this server. The host must be
/// a numeric address, localhost, this machine's name (also with ".local") or the host that the server was
/// started with. Other names are refused to prevent DNS rebinding. In this attack a foreign name resolves to
/// this machine, so that a browser treats the foreign page and this server as one site.
bool is_server_host(std::string_view header, const Address& server);

/// Returns whether a page of this origin may connect. The server's own page, pages from localhost or a
/// loopback address, local files and Foxglove's page may connect. Programs that are not browsers send no
/// origin. Therefore the empty origin may connect, too.
bool may_connect(std::string_view origin, std::string_view host_header);

}  // namespace pcl_bv::live
