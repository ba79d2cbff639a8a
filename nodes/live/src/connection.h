// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A TCP connection that answers one HTTP request or becomes a WebSocket (Viewer).
#pragma once

#include <memory>

#include "access.h"
#include "viewer.h"

namespace pcl_bv::live {
using namespace detail;

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  static constexpr int kMaxConnections = 64;  ///< Maximum number of connections that are not viewers.

  Connection(boost::asio::ip::tcp::socket&& socket, Hub& hub, const Address& server, int& open);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void start();

 private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::empty_body>;
  using Response = boost::beast::http::response<boost::beast::http::string_body>;

  void on_request();
  std::string refusal_reason(const HttpRequest& request) const;
  void upgrade(const HttpRequest& request);
  Response answer(const HttpRequest& request) const;
  void reply(Response response);

  boost::beast::tcp_stream stream_;
  Hub& hub_;
  const Address& server_;
  int& open_;
  boost::beast::flat_buffer buffer_;
  Parser parser_;
  std::shared_ptr<Response> response_;
};

}  // namespace pcl_bv::live
