// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The server of the middleware "ws".
#pragma once

#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "connection.h"

namespace pcl_bv::live {
using namespace detail;

/// Serves all viewers on one port. The server has its own thread, so that send() never waits for a viewer.
class Server final : public MessageSender {
 public:
  /// Listens at the address, [HOST:]PORT. Throws std::invalid_argument as parse_address() does, and IoError
  /// if the port cannot be opened.
  explicit Server(const std::string& address);
  ~Server() override;
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::size_t add_topic(const MessageTopic& topic) override;
  bool has_subscribers(std::size_t topic) const override;
  void send(std::size_t topic, std::int64_t stamp_ns, const std::vector<std::byte>& message) override;
  void announce_settings(const std::string& yaml, std::int64_t stamp_ns) override;
  void offer_settings(const std::shared_ptr<RemoteParameters>& settings) override;
  void notify(const std::string& line) override;
  std::vector<std::string> take_warnings() override;
  void close() override;

 private:
  void listen();
  void accept();
  template <class Do>
  void post_to_server_thread(Do&& what);

  Address address_;
  boost::asio::io_context io_{1};
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_{io_.get_executor()};
  boost::asio::ip::tcp::acceptor acceptor_{io_};
  Hub hub_;
  int connections_ = 0;
  std::atomic<std::size_t> queued_bytes_{0};  // bytes of messages that wait for the server's thread
  std::atomic<std::uint64_t> lost_{0};
  std::vector<std::shared_ptr<Channel>> channels_;
  std::promise<void> ended_;
  std::thread thread_;
};

}  // namespace pcl_bv::live
