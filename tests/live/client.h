// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A viewer as programs write one, which does at most what it is told, and waits for nothing longer than 20 s.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

namespace pcl_bv::test {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Json = nlohmann::json;

struct Received {
  bool text = false;
  std::string bytes;

  Json json() const { return Json::parse(bytes); }
  std::string op() const { return text ? json().at("op").get<std::string>() : ""; }
  std::uint8_t opcode() const { return text || bytes.empty() ? 0 : static_cast<std::uint8_t>(bytes[0]); }
  std::uint64_t number(std::size_t at, std::size_t size) const {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value |= std::uint64_t{static_cast<std::uint8_t>(bytes.at(at + i))} << (8 * i);
    return value;
  }
};

class Client {
 public:
  static constexpr std::chrono::seconds kPatience{20};

  /// Connects by TCP only.
  explicit Client(std::uint16_t port) {
    ws_.next_layer().connect(asio::ip::tcp::endpoint(asio::ip::make_address("127.0.0.1"), port));
  }

  /// Throws boost::system::system_error where it is refused; its answer is response().
  void open(const std::string& subprotocol = "foxglove.sdk.v1", const std::string& host = "localhost",
            const std::string& origin = "") {
    ws_.set_option(websocket::stream_base::decorator([=](websocket::request_type& request) {
      if (!subprotocol.empty()) request.set(http::field::sec_websocket_protocol, subprotocol);
      if (!origin.empty()) request.set(http::field::origin, origin);
    }));
    ws_.read_message_max(0);
    done([&](auto then) { ws_.async_handshake(response_, host, "/", then); });
  }

  const websocket::response_type& response() const { return response_; }

  void say(const Json& request) { send(request.dump(), true); }
  void send(const std::string& bytes, bool text) {
    ws_.text(text);
    done([&](auto then) {
      ws_.async_write(asio::buffer(bytes), [then](beast::error_code error, std::size_t) { then(error); });
    });
  }
  /// As they are, without a frame around them.
  void send_raw(const std::string& bytes) {
    done([&](auto then) {
      asio::async_write(ws_.next_layer().socket(), asio::buffer(bytes),
                        [then](beast::error_code error, std::size_t) { then(error); });
    });
  }

  /// The next message; throws boost::system::system_error at the end.
  Received next() {
    beast::flat_buffer buffer;
    done([&](auto then) {
      ws_.async_read(buffer, [then](beast::error_code error, std::size_t) { then(error); });
    });
    return {ws_.got_text(), beast::buffers_to_string(buffer.data())};
  }

  /// The next text with this op; others are skipped.
  Json await(const std::string& op) {
    for (;;) {
      const Received received = next();
      if (received.op() == op) return received.json();
    }
  }

  /// The next message of any channel, without time.
  Received await_message() {
    for (;;) {
      Received received = next();
      if (received.opcode() == 1) return received;
    }
  }

  /// Whether it was closed by the other side; what comes before that is read.
  bool is_closed() {
    try {
      for (;;)
        next();
    } catch (const boost::system::system_error& error) {
      return error.code() != beast::error::timeout;
    }
  }

  http::response<http::string_body> get(const std::string& target, const std::string& host = "localhost",
                                        const std::string& origin = "", http::verb verb = http::verb::get) {
    http::request<http::empty_body> request(verb, target, 11);
    request.set(http::field::host, host);
    if (!origin.empty()) request.set(http::field::origin, origin);
    http::response_parser<http::string_body> parser;
    parser.skip(verb == http::verb::head);
    beast::flat_buffer buffer;
    done([&](auto then) {
      http::async_write(ws_.next_layer(), request,
                        [then](beast::error_code error, std::size_t) { then(error); });
    });
    done([&](auto then) {
      http::async_read(ws_.next_layer(), buffer, parser,
                       [then](beast::error_code error, std::size_t) { then(error); });
    });
    return parser.release();
  }

 private:
  template <class Start>
  void done(const Start& start) {
    std::optional<beast::error_code> result;
    start([&result](beast::error_code error) { result = error; });
    io_.restart();
    const auto until = std::chrono::steady_clock::now() + kPatience;
    while (!result && io_.run_one_until(until) > 0)
      ;
    if (!result) {  // what was begun must not outlive what it uses
      ws_.next_layer().close();
      io_.restart();
      io_.run();
      throw boost::system::system_error(beast::error::timeout);
    }
    if (*result) throw boost::system::system_error(*result);
  }

  asio::io_context io_;
  websocket::stream<beast::tcp_stream> ws_{io_};
  websocket::response_type response_;
};

}  // namespace pcl_bv::test
