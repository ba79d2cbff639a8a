// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A client's WebSocket: its subscriptions and its queue of outgoing messages.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <map>
#include <memory>
#include <string>

#include "hub.h"

namespace pcl_bv::live {
using namespace detail;

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  static constexpr std::size_t kMaxViewers = 32;
  static constexpr std::size_t kMaxQueuedBytes = std::size_t{32} << 20;  ///< Enough for 16 clouds of 2 MB.
  static constexpr std::size_t kMaxQueuedAnswers = 256;
  /// Limits on a client's requests. Parsing the requests of one second delays other clients by at most some
  /// milliseconds. A request with 30 settings has 2 kB.
  static constexpr std::size_t kMaxRequestBytes = std::size_t{64} << 10;
  static constexpr std::size_t kMaxRequestBytesPerSecond = 4 * kMaxRequestBytes;
  static constexpr std::size_t kMaxRequestsPerSecond = 200;

  Viewer(boost::beast::tcp_stream&& stream, Hub& hub) : ws_(std::move(stream)), hub_(hub) {}

  void start(const HttpRequest& request, const std::string& subprotocol);

  /// Queues a text that is never dropped. A client with kMaxQueuedAnswers unread texts is disconnected.
  void queue_text(const std::string& text);

  /// Queues a message if the client has subscribed to its channel. If the queue would exceed kMaxQueuedBytes,
  /// the messages in the queue are dropped first, but not the texts. The client is then not counted as a
  /// reader until it reads again. Otherwise messages would be produced for a client that hangs.
  void send(std::size_t channel, std::int64_t stamp_ns, const Bytes& message);
  void send_time(std::int64_t stamp_ns);

  void subscribe(std::uint32_t subscription, std::size_t channel);
  void unsubscribe(std::uint32_t subscription);
  void watch_settings(bool watch) { watches_settings_ = watch; }
  bool watches_settings() const { return watches_settings_; }

  /// Sends the queue, then closes the connection.
  void finish();

 private:
  struct Outgoing {
    std::string text;  // the whole text, or the header before `message`
    Bytes message;
    bool is_text = false;
    bool is_answer = false;
    std::size_t size() const { return text.size() + (message == nullptr ? 0 : message->size()); }
  };

  void read();
  void on_request();
  void enqueue(Outgoing outgoing);
  void drop_queued_messages();
  void count_as_reader(bool reads);
  void write();
  void on_written(const boost::system::error_code& error);
  void close(boost::beast::websocket::close_code code);
  void drop_connection();

  boost::beast::websocket::stream<boost::beast::tcp_stream> ws_;
  Hub& hub_;
  boost::beast::flat_buffer buffer_;
  std::deque<Outgoing> send_queue_;  // the first element is being sent if `writing_`
  std::size_t queued_bytes_ = 0, queued_answers_ = 0;
  std::uint64_t dropped_ = 0;
  bool writing_ = false, open_ = false, finishing_ = false, closing_ = false, watches_settings_ = false;
  bool counted_as_reader_ = true;                       // in `readers` of the subscribed channels
  std::map<std::size_t, std::uint32_t> subscriptions_;  // channel id -> subscription id
  RateLimit requests_{kMaxRequestsPerSecond}, request_bytes_{kMaxRequestBytesPerSecond};
};

}  // namespace pcl_bv::live
