// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "viewer.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pcl_bv::live {
using namespace detail;

namespace asio = boost::asio;
namespace websocket = boost::beast::websocket;
using Error = boost::system::error_code;

void Viewer::start(const HttpRequest& request, const std::string& subprotocol) {
  boost::beast::get_lowest_layer(ws_).expires_never();  // the WebSocket has its own timeouts
  ws_.set_option(websocket::stream_base::timeout{std::chrono::seconds(10), std::chrono::seconds(30), true});
  ws_.set_option(websocket::stream_base::decorator([subprotocol](websocket::response_type& response) {
    response.set(boost::beast::http::field::sec_websocket_protocol, subprotocol);
  }));
  ws_.read_message_max(kMaxRequestBytes);
  ws_.auto_fragment(false);
  ws_.async_accept(request, [self = shared_from_this()](const Error& error) {
    if (error) return;
    self->open_ = true;
    self->hub_.join(self);
    self->read();
  });
}

void Viewer::read() {
  ws_.async_read(buffer_, [self = shared_from_this()](const Error& error, std::size_t) {
    if (error) return self->drop_connection();
    self->on_request();
    self->buffer_.consume(self->buffer_.size());
    if (!self->closing_) self->read();
  });
}

void Viewer::on_request() {
  if (!requests_.allows(1) || !request_bytes_.allows(buffer_.size()))
    return close(websocket::close_code::policy_error);
  if (!ws_.got_text()) return queue_text(status(Level::error, "clients cannot publish here"));
  hub_.handle(*this, parse_request(boost::beast::buffers_to_string(buffer_.data())));
}

void Viewer::queue_text(const std::string& text) {
  if (queued_answers_ >= kMaxQueuedAnswers) return drop_connection();
  enqueue({text, nullptr, true, true});
}

void Viewer::send(std::size_t channel, std::int64_t stamp_ns, const Bytes& message) {
  const auto found = subscriptions_.find(channel);
  if (found == subscriptions_.end()) return;
  const MessageHeader header = message_header(found->second, stamp_ns);
  enqueue({std::string(header.begin(), header.end()), message, false, false});
}

void Viewer::send_time(std::int64_t stamp_ns) {
  if (!subscriptions_.empty()) enqueue({time_message(stamp_ns), nullptr, false, false});
}

void Viewer::subscribe(std::uint32_t subscription, std::size_t channel) {
  if (channel >= hub_.channels().size())
    return queue_text(status(Level::error, "there is no channel " + std::to_string(channel)));
  if (!subscriptions_.emplace(channel, subscription).second)
    return queue_text(status(Level::error, "channel " + std::to_string(channel) + " is subscribed already"));
  hub_.channels()[channel]->readers += counted_as_reader_;
}

void Viewer::unsubscribe(std::uint32_t subscription) {
  for (auto it = subscriptions_.begin(); it != subscriptions_.end(); ++it) {
    if (it->second != subscription) continue;
    hub_.channels()[it->first]->readers -= counted_as_reader_;
    subscriptions_.erase(it);
    return;
  }
  queue_text(status(Level::error, "there is no subscription " + std::to_string(subscription)));
}

void Viewer::enqueue(Outgoing outgoing) {
  if (!open_ || closing_) return;
  if (!outgoing.is_answer && queued_bytes_ + outgoing.size() > kMaxQueuedBytes) drop_queued_messages();
  queued_bytes_ += outgoing.size();
  queued_answers_ += outgoing.is_answer;
  send_queue_.push_back(std::move(outgoing));
  write();
}

void Viewer::drop_queued_messages() {
  const auto first = send_queue_.begin() + (writing_ ? 1 : 0);
  const auto dropped = [this](const Outgoing& outgoing) {
    if (outgoing.is_answer) return false;
    queued_bytes_ -= outgoing.size();
    dropped_ += outgoing.message != nullptr;
    return true;
  };
  send_queue_.erase(std::remove_if(first, send_queue_.end(), dropped), send_queue_.end());
  count_as_reader(false);
}

void Viewer::count_as_reader(bool reads) {
  const int change = reads - counted_as_reader_;
  counted_as_reader_ = reads;
  for (const auto& [channel, subscription] : subscriptions_)
    hub_.channels()[channel]->readers += change;
}

void Viewer::write() {
  if (writing_ || send_queue_.empty()) return;
  writing_ = true;
  const Outgoing& next = send_queue_.front();
  ws_.text(next.is_text);
  std::array<asio::const_buffer, 2> parts{asio::buffer(next.text)};
  if (next.message != nullptr) parts[1] = {next.message->data(), next.message->size()};
  ws_.async_write(parts,
                  [self = shared_from_this()](const Error& error, std::size_t) { self->on_written(error); });
}

void Viewer::on_written(const Error& error) {
  writing_ = false;
  if (error) return drop_connection();
  queued_bytes_ -= send_queue_.front().size();
  queued_answers_ -= send_queue_.front().is_answer;
  send_queue_.pop_front();
  count_as_reader(true);
  if (dropped_ > 0) {
    queue_text(status(Level::warning, std::to_string(std::exchange(dropped_, 0)) +
                                          " messages were dropped: this client reads too slowly"));
  }
  if (send_queue_.empty() && finishing_) return close(websocket::close_code::going_away);
  write();
}

void Viewer::finish() {
  finishing_ = true;
  if (send_queue_.empty()) close(websocket::close_code::going_away);
}

void Viewer::close(websocket::close_code code) {
  if (std::exchange(closing_, true)) return;
  ws_.async_close(code, [self = shared_from_this()](const Error&) { self->drop_connection(); });
}

// Cancels pending asynchronous operations. They end with an error and release their references to the viewer.
void Viewer::drop_connection() {
  if (!std::exchange(open_, false)) return;
  closing_ = true;
  count_as_reader(false);
  subscriptions_.clear();
  boost::beast::get_lowest_layer(ws_).cancel();
  asio::post(ws_.get_executor(), [self = shared_from_this()] {
    self->hub_.leave(self);  // posted, because the hub may be iterating over its viewers now
    boost::beast::get_lowest_layer(self->ws_).close();
  });
}

}  // namespace pcl_bv::live
