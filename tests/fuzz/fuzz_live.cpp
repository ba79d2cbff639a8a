// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What viewers and browsers send: requests, addresses, hosts and origins.

#include <cstdint>
#include <stdexcept>
#include <string>

#include "access.h"
#include "protocol.h"

namespace pcl_bv::live {
using namespace detail;
namespace {

// What a request sets is passed on as an object of JSON whatever the values are, and an answer can name it.
void look(const std::string& text) {
  const Request request = parse_request(text);
  if (const auto* set = std::get_if<SetParameters>(&request)) {
    const std::string answer = parameter_values(set->object, set->names, set->id);
    if (!std::holds_alternative<InvalidRequest>(parse_request(answer)))
      __builtin_trap();  // no client says that
  }
  known_subprotocol(text);
  try {
    parse_address(text);
  } catch (const std::invalid_argument&) {
  }
  is_server_host(text, {});
  // A page of another site never gets in by the way it writes itself.
  if (may_connect("http://" + text + ".evil.example", text) && text.find_first_of("[:") == std::string::npos)
    __builtin_trap();
}

}  // namespace
}  // namespace pcl_bv::live

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pcl_bv::live::look({reinterpret_cast<const char*>(data), size});
  return 0;
}
