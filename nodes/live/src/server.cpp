// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "server.h"

#include <pthread.h>

#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <csignal>
#include <utility>

#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::live {
using namespace detail;
namespace {

using tcp = boost::asio::ip::tcp;
using Error = boost::system::error_code;

std::string now_as_text() {
  return std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
}

// Starts a thread that blocks all signals, so that the program's own threads handle them.
template <class Run>
std::thread thread_without_signals(Run&& run) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(std::forward<Run>(run));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace

Server::Server(const std::string& address) : address_(parse_address(address)), hub_(now_as_text()) {
  try {
    listen();
  } catch (const boost::system::system_error& error) {
    const bool of_system = error.code().category() == boost::system::system_category();
    throw IoError(of_system ? system_reason(error.code().value()) : "host name not found");
  }
  accept();
  thread_ = thread_without_signals([this] {
    io_.run();
    ended_.set_value();
  });
}

Server::~Server() {
  close();
}

void Server::listen() {
  const auto found =
      tcp::resolver(io_).resolve(address_.host, std::to_string(address_.port), tcp::resolver::passive);
  const tcp::endpoint endpoint = found.begin()->endpoint();
  acceptor_.open(endpoint.protocol());
  acceptor_.set_option(tcp::acceptor::reuse_address(true));
  acceptor_.bind(endpoint);
  acceptor_.listen();
  const bool six = endpoint.address().is_v6();
  const std::string host = address_.host;
  hub_.add_warning("viewer page: http://" +
                   (six && host.find(':') != std::string::npos ? '[' + host + ']' : host) + ':' +
                   std::to_string(acceptor_.local_endpoint().port()) + "/");
}

void Server::accept() {
  acceptor_.async_accept([this](const Error& error, tcp::socket socket) {
    if (!acceptor_.is_open()) return;
    if (!error && connections_ < Connection::kMaxConnections)
      std::make_shared<Connection>(std::move(socket), hub_, address_, connections_)->start();
    if (!error) return accept();
    // The process has usually run out of file descriptors. Keep the connections and accept again after 100
    // ms.
    const auto pause = std::make_shared<boost::asio::steady_timer>(io_, std::chrono::milliseconds(100));
    pause->async_wait([this, pause](const Error&) {
      if (acceptor_.is_open()) accept();
    });
  });
}

template <class Do>
void Server::post_to_server_thread(Do&& what) {
  boost::asio::post(io_, std::forward<Do>(what));
}

std::size_t Server::add_topic(const MessageTopic& topic) {
  const auto channel = std::make_shared<Channel>();
  channel->topic = topic;
  channels_.push_back(channel);
  post_to_server_thread([this, channel] { hub_.add(channel); });
  return channels_.size() - 1;
}

bool Server::has_subscribers(std::size_t topic) const {
  return channels_.at(topic)->readers > 0;
}

void Server::send(std::size_t topic, std::int64_t stamp_ns, const std::vector<std::byte>& message) {
  if (!has_subscribers(topic)) return;
  if (queued_bytes_ > 0 && queued_bytes_ + message.size() > Viewer::kMaxQueuedBytes) {
    ++lost_;
    return;
  }
  queued_bytes_ += message.size();
  const Bytes copy = std::make_shared<const std::vector<std::byte>>(message);
  post_to_server_thread([this, topic, stamp_ns, copy] {
    queued_bytes_ -= copy->size();
    if (const std::uint64_t lost = lost_.exchange(0); lost > 0)
      hub_.notice(std::to_string(lost) + " messages were dropped: the server was busy");
    hub_.publish(topic, stamp_ns, copy);
  });
}

void Server::announce_settings(const std::string&, std::int64_t) {
  post_to_server_thread([this] { hub_.send_settings(); });
}

void Server::offer_settings(const std::shared_ptr<RemoteParameters>& settings) {
  post_to_server_thread([this, settings] { hub_.offer(settings); });
}

void Server::notify(const std::string& line) {
  post_to_server_thread([this, line] { hub_.notice(line); });
}

std::vector<std::string> Server::take_warnings() {
  return hub_.take_warnings();
}

void Server::close() {
  if (!thread_.joinable()) return;
  post_to_server_thread([this] {
    acceptor_.close();
    hub_.finish();
    work_.reset();
  });
  // Wait at most 1 s for viewers that do not read.
  if (ended_.get_future().wait_for(std::chrono::seconds(1)) == std::future_status::timeout) io_.stop();
  thread_.join();
}

}  // namespace pcl_bv::live
