// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hub.h"

#include <utility>

#include "viewer.h"

namespace pcl_bv::live {
using namespace detail;

std::vector<MessageTopic> Hub::topics() const {
  std::vector<MessageTopic> topics;
  for (const auto& channel : channels_)
    topics.push_back(channel->topic);
  return topics;
}

void Hub::add(std::shared_ptr<Channel> channel) {
  channels_.push_back(std::move(channel));
  const std::string text = advertisement(topics(), channels_.size() - 1);
  for (const auto& viewer : viewers_)
    viewer->queue_text(text);
}

void Hub::publish(std::size_t channel, std::int64_t stamp_ns, const Bytes& message) {
  const bool later = std::exchange(last_time_ns_, stamp_ns) != stamp_ns;
  for (const auto& viewer : viewers_) {
    if (later) viewer->send_time(stamp_ns);
    viewer->send(channel, stamp_ns, message);
  }
}

void Hub::notice(const std::string& line) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_notice_time_ < std::chrono::seconds(1)) {
    ++skipped_notices_;
    return;
  }
  last_notice_time_ = now;
  const std::uint64_t others = std::exchange(skipped_notices_, 0);
  const std::string text =
      status(Level::warning, others == 0 ? line : line + "; " + std::to_string(others) + " more before");
  for (const auto& viewer : viewers_)
    viewer->queue_text(text);
}

void Hub::offer(std::shared_ptr<RemoteParameters> settings) {
  settings_ = std::move(settings);
  send_settings();
}

void Hub::send_settings() {
  if (settings_ == nullptr) return;
  std::string values = settings_->values();
  if (values == sent_values_) return;
  sent_values_ = std::move(values);
  const std::string text = parameter_values(sent_values_, {}, "");
  for (const auto& viewer : viewers_)
    if (viewer->watches_settings()) viewer->queue_text(text);
}

std::string Hub::description() const {
  return settings_ == nullptr ? "[]" : settings_->description();
}

void Hub::join(const std::shared_ptr<Viewer>& viewer) {
  viewers_.insert(viewer);
  viewer->queue_text(server_info(session_));
  viewer->queue_text(advertisement(topics(), 0));
}

void Hub::leave(const std::shared_ptr<Viewer>& viewer) {
  viewers_.erase(viewer);
}

void Hub::finish() {
  for (const auto& viewer : std::exchange(viewers_, {}))
    viewer->finish();
}

void Hub::change(Viewer& viewer, const SetParameters& wanted) {
  if (!changes_.allows(1)) {
    return viewer.queue_text(status(Level::error, "too many changes of settings: the limit is " +
                                                      std::to_string(kMaxChangesPerSecond) + " a second"));
  }
  const std::string problem =
      settings_ == nullptr ? "there are no settings" : settings_->change(wanted.object);
  if (!problem.empty()) viewer.queue_text(status(Level::error, problem));
  if (settings_ == nullptr) return;
  send_settings();
  if (!wanted.id.empty() || !problem.empty())
    viewer.queue_text(parameter_values(settings_->values(), wanted.names, wanted.id));
}

void Hub::handle(Viewer& viewer, const Request& request) {
  if (const auto* wanted = std::get_if<Subscribe>(&request)) {
    for (const auto& [subscription, channel] : wanted->subscriptions)
      viewer.subscribe(subscription, channel);
  } else if (const auto* unwanted = std::get_if<Unsubscribe>(&request)) {
    for (const std::uint32_t subscription : unwanted->subscriptions)
      viewer.unsubscribe(subscription);
  } else if (const auto* get = std::get_if<GetParameters>(&request)) {
    viewer.queue_text(
        parameter_values(settings_ == nullptr ? "{}" : settings_->values(), get->names, get->id));
  } else if (const auto* set = std::get_if<SetParameters>(&request)) {
    change(viewer, *set);
  } else if (const auto* watch = std::get_if<WatchParameters>(&request)) {
    viewer.watch_settings(watch->watch);
  } else {
    viewer.queue_text(status(Level::error, std::get<InvalidRequest>(request).why));
  }
}

void Hub::add_warning(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (std::exchange(last_warning_, line) != line && warnings_.size() < kMaxStoredWarnings)
    warnings_.push_back(line);
}

std::vector<std::string> Hub::take_warnings() {
  const std::lock_guard lock(mutex_);
  return std::exchange(warnings_, {});
}

}  // namespace pcl_bv::live
