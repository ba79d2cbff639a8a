// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Who may connect. Any page that a browser shows can open a WebSocket to any address, this machine's own too;
// what it cannot do is lie about where it comes from.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pcl_bv::live {

struct Address {
  std::string host = "127.0.0.1";
  std::uint16_t port = 0;
};

/// Of "8765", "localhost:8765", "0.0.0.0:8765" or "[::1]:8765". Throws std::invalid_argument for anything
/// else; port 0 means any that is free.
Address parse_address(const std::string& text);

/// Whether the host that a client believes to speak to (its header Host, "localhost:8765") can be this one:
/// an address as numbers, localhost, this machine's name or what the server was told. Others are names that
/// somebody else has pointed here, so that a browser takes his page and this server for one site.
bool is_our_host(std::string_view header, const Address& server);

/// Whether a page from there may connect: our own, one of this machine, or Foxglove's. Programs send none.
bool may_connect(std::string_view origin, std::string_view host_header);

}  // namespace pcl_bv::live
