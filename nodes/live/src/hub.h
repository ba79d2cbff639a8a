// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The state that all viewers share: channels, settings and the set of viewers.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "protocol.h"

namespace pcl_bv::live {
using namespace detail;

class Viewer;

using Bytes = std::shared_ptr<const std::vector<std::byte>>;

/// A topic and the number of its readers. Any thread may use `readers`.
struct Channel {
  MessageTopic topic;
  std::atomic<int> readers{0};
};

/// Allows at most `limit` units per second.
class RateLimit {
 public:
  explicit RateLimit(std::size_t limit) : limit_(limit) {}
  bool allows(std::size_t more) {
    const auto now = std::chrono::steady_clock::now();
    if (now - second_ > std::chrono::seconds(1)) {
      second_ = now;
      used_ = 0;
    }
    used_ += more;
    return used_ <= limit_;
  }

 private:
  std::size_t limit_, used_ = 0;
  std::chrono::steady_clock::time_point second_{};
};

/// The shared state of all viewers. Only the server's thread uses it, except where noted.
class Hub {
 public:
  /// Limit on the changes of settings by all viewers together. A change takes up to 1 ms, so changes take at
  /// most 5 % of the time of the server's thread.
  static constexpr std::size_t kMaxChangesPerSecond = 50;
  static constexpr std::size_t kMaxStoredWarnings = 10;  ///< Limit for take_warnings().

  explicit Hub(std::string session) : session_(std::move(session)) {}

  void add(std::shared_ptr<Channel> channel);
  void publish(std::size_t channel, std::int64_t stamp_ns, const Bytes& message);

  /// Sends a warning to all viewers, at most one per second. Other warnings are skipped. The next warning
  /// that is sent gives the number of skipped warnings.
  void notice(const std::string& line);

  void offer(std::shared_ptr<RemoteParameters> settings);

  /// Sends the values of the settings to the viewers that watch them, if the values have changed since they
  /// were last sent.
  void send_settings();

  /// Returns RemoteParameters::description(), or "[]" if there are no settings.
  std::string description() const;

  void join(const std::shared_ptr<Viewer>& viewer);
  void leave(const std::shared_ptr<Viewer>& viewer);
  std::size_t viewers() const { return viewers_.size(); }
  void handle(Viewer& viewer, const Request& request);

  /// Closes the connections of all viewers after sending their queued messages.
  void finish();

  /// Stores a warning for take_warnings(), unless it equals the previous one. Any thread may call
  /// add_warning() and take_warnings().
  void add_warning(const std::string& line);
  std::vector<std::string> take_warnings();

  const std::vector<std::shared_ptr<Channel>>& channels() const { return channels_; }

 private:
  void change(Viewer& viewer, const SetParameters& wanted);
  std::vector<MessageTopic> topics() const;

  std::string session_;
  std::vector<std::shared_ptr<Channel>> channels_;
  std::set<std::shared_ptr<Viewer>> viewers_;
  std::shared_ptr<RemoteParameters> settings_;
  std::string sent_values_;
  std::int64_t last_time_ns_ = INT64_MIN;
  std::chrono::steady_clock::time_point last_notice_time_{};
  std::uint64_t skipped_notices_ = 0;
  RateLimit changes_{kMaxChangesPerSecond};
  std::mutex mutex_;
  std::vector<std::string> warnings_;
  std::string last_warning_;
};

}  // namespace pcl_bv::live
