// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "connection.h"

#include <utility>

#include "../page.h"

namespace pcl_bv::live {
using namespace detail;
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using Error = boost::system::error_code;

constexpr std::chrono::seconds kHttpTimeout{10};  // for reading the request, and for writing the reply

// The page may load no other resources and connect only to its own server.
constexpr const char* kContentSecurityPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
    "connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

}  // namespace

Connection::Connection(boost::asio::ip::tcp::socket&& socket, Hub& hub, const Address& server, int& open)
    : stream_(std::move(socket)), hub_(hub), server_(server), open_(open) {
  ++open_;
  parser_.header_limit(8192);
}
Connection::~Connection() {
  --open_;
}

void Connection::start() {
  Error ignored;
  stream_.socket().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
  stream_.expires_after(kHttpTimeout);
  http::async_read(stream_, buffer_, parser_, [self = shared_from_this()](const Error& error, std::size_t) {
    if (!error) self->on_request();
  });
}

void Connection::on_request() {
  const HttpRequest& request = parser_.get();
  if (const std::string why = refusal_reason(request); !why.empty()) {
    hub_.add_warning("refused: " + why);
    Response response(http::status::forbidden, request.version(), why + '\n');
    response.set(http::field::content_type, "text/plain; charset=utf-8");
    return reply(std::move(response));
  }
  if (beast::websocket::is_upgrade(request)) return upgrade(request);
  reply(answer(request));
}

std::string Connection::refusal_reason(const HttpRequest& request) const {
  const auto text = [&](http::field field) { return std::string(request[field]); };
  const std::string host = text(http::field::host), origin = text(http::field::origin);
  if (!is_server_host(host, server_)) return "the host '" + host.substr(0, 100) + "' is not this one";
  if (!may_connect(origin, host)) return "a page of '" + origin.substr(0, 100) + "' may not connect";
  return {};
}

void Connection::upgrade(const HttpRequest& request) {
  const auto offered = request[http::field::sec_websocket_protocol];
  const auto subprotocol = known_subprotocol({offered.data(), offered.size()});
  if (!subprotocol || hub_.viewers() >= Viewer::kMaxViewers) {
    const bool full = subprotocol.has_value();
    return reply({full ? http::status::service_unavailable : http::status::bad_request, request.version(),
                  full ? "too many viewers\n" : "subprotocols: foxglove.sdk.v1, foxglove.websocket.v1\n"});
  }
  std::make_shared<Viewer>(std::move(stream_), hub_)->start(request, *subprotocol);
}

Connection::Response Connection::answer(const HttpRequest& request) const {
  const auto text = [&](http::status status, std::string body, const char* type) {
    Response response(status, request.version(), std::move(body));
    response.set(http::field::content_type, type);
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    return response;
  };
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    Response response = text(http::status::method_not_allowed, "GET and HEAD only\n", "text/plain");
    response.set(http::field::allow, "GET, HEAD");
    return response;
  }
  if (request.target() == "/") {
    Response response = text(http::status::ok, std::string(live_page()), "text/html; charset=utf-8");
    response.set("Content-Security-Policy", kContentSecurityPolicy);
    return response;
  }
  if (request.target() == "/settings") return text(http::status::ok, hub_.description(), "application/json");
  return text(http::status::not_found, "not found: this server has / and /settings only\n", "text/plain");
}

void Connection::reply(Response response) {
  response.set(http::field::server, "pcl_bv");
  response.keep_alive(false);
  response.prepare_payload();
  if (parser_.get().method() == http::verb::head) response.body().clear();  // Content-Length is set already
  response_ = std::make_shared<Response>(std::move(response));
  stream_.expires_after(kHttpTimeout);
  http::async_write(stream_, *response_, [self = shared_from_this()](Error error, std::size_t) {
    self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, error);
  });
}

}  // namespace pcl_bv::live
