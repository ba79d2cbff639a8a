// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <chrono>
#include <fstream>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "cdr_type.h"
#include "endpoints.h"
#include "participant.h"

namespace pcl_bv::dds {
using namespace detail;
namespace {

using Clock = std::chrono::steady_clock;

constexpr long kMinReceiveBuffer = 8 << 20;

struct Unref {
  void operator()(ddsi_serdata* sample) const { ddsi_serdata_unref(sample); }
};

// Returns the QoS of a reader. For clouds, it matches the writers of all drivers: a best-effort reader also
// matches reliable writers. For transforms, it is that of ROS's tf2 listener.
Qos reader_qos(Delivery delivery) {
  Qos qos = make_qos();
  const bool newest = delivery == Delivery::newest;
  constexpr int waiting_transforms = 1000;
  dds_qset_reliability(qos.get(), newest ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                       DDS_MSECS(100));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, newest ? 2 : waiting_transforms);
  if (delivery == Delivery::latched) dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

// Returns a warning if Linux limits a socket's receive buffer (rmem_max) to less than kMinReceiveBuffer,
// otherwise "".
std::string receive_buffer_warning() {
  long limit = kMinReceiveBuffer;
  std::ifstream("/proc/sys/net/core/rmem_max") >> limit;
  if (limit >= kMinReceiveBuffer) return "";
  return "the kernel limits socket receive buffers to " + std::to_string(limit) +
         " bytes: large clouds may be lost. Fix: sudo sysctl -w net.core.rmem_max=" +
         std::to_string(kMinReceiveBuffer);
}

// A reader of one type. The members are destroyed in reverse order, the reader before its topic.
struct Subscription {
  Subscription(dds_entity_t participant, const std::string& name, const std::string& type, Delivery delivery)
      : topic(create_cdr_topic(participant, name, type), name),
        reader(dds_create_reader(participant, topic.get(), reader_qos(delivery).get(), nullptr), name),
        read_condition(dds_create_readcondition(reader.get(), DDS_ANY_STATE), name) {}

  bool has_publishers() const {
    dds_subscription_matched_status_t matched{};
    return dds_get_subscription_matched_status(reader.get(), &matched) >= 0 && matched.current_count > 0;
  }

  Entity topic, reader, read_condition;
};

std::vector<std::string> dds_types(const std::vector<std::string>& types) {
  if (types.empty()) throw std::invalid_argument("a receiver needs a type of messages");
  std::vector<std::string> names;
  names.reserve(types.size());
  for (const std::string& type : types)
    names.push_back(dds_type(type));
  return names;
}

class Receiver final : public MessageReceiver {
 public:
  Receiver(const std::string& topic, const std::vector<std::string>& types, Delivery delivery)
      : types_(dds_types(types)),
        name_(dds_topic(topic)),
        delivery_(delivery),
        participant_(Participant::shared()),
        publications_(
            dds_create_reader(participant_->get(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
            topic),
        publisher_condition_(dds_create_readcondition(publications_.get(), DDS_ANY_STATE), topic),
        waitset_(dds_create_waitset(participant_->get()), topic) {
    dds_get_instance_handle(participant_->get(), &own_handle_);
    dds_waitset_attach(waitset_.get(), publisher_condition_.get(), 0);
    subscribe(0);
    if (delivery != Delivery::newest) return;  // transforms are small
    if (std::string warning = receive_buffer_warning(); !warning.empty())
      pending_warnings_.push_back(std::move(warning));
  }

  bool next(ReceivedMessage& message, std::chrono::milliseconds timeout) override {
    const Clock::time_point until = Clock::now() + timeout;
    do {
      inspect_publishers();
      if (take(message)) return true;
      const auto left = std::max(until - Clock::now(), Clock::duration(0));
      dds_waitset_wait(waitset_.get(), nullptr, 0, std::chrono::nanoseconds(left).count());
    } while (Clock::now() < until);
    return take(message);
  }

  std::vector<std::string> take_warnings() override {
    std::vector<std::string> all = std::exchange(pending_warnings_, {});
    for (std::string& line : participant_->take_log())
      all.push_back(std::move(line));
    report_losses(all);
    report_refused_publishers(all);
    return all;
  }

 private:
  void subscribe(std::size_t type) {
    subscription_.reset();  // a participant has only one topic of a name
    subscription_.emplace(participant_->get(), name_, types_[type], delivery_);
    dds_waitset_attach(waitset_.get(), subscription_->read_condition.get(), 0);
    type_ = type;
  }

  bool take(ReceivedMessage& message) {
    for (;;) {
      ddsi_serdata* sample = nullptr;
      dds_sample_info_t info;
      if (dds_takecdr(subscription_->reader.get(), &sample, 1, &info, DDS_ANY_STATE) <= 0) return false;
      std::shared_ptr<ddsi_serdata> owner(sample, Unref());
      if (!info.valid_data) continue;  // no message: a writer has left
      const CdrSample& cdr = *static_cast<const CdrSample*>(sample);
      message = {cdr.bytes.get(), cdr.size, std::move(owner), info.source_timestamp, type_};
      return true;
    }
  }

  // Reports messages lost because of missing fragments or an overloaded network.
  void report_losses(std::vector<std::string>& all) {
    dds_sample_lost_status_t lost{};
    if (dds_get_sample_lost_status(subscription_->reader.get(), &lost) < 0 || lost.total_count_change == 0)
      return;
    all.push_back(std::to_string(lost.total_count_change) + " messages lost, " +
                  std::to_string(lost.total_count) + " in total");
  }

  // Inspects the publishers that have appeared on this topic since the last call. Changes the type to that of
  // a publisher if there is none of the present type.
  void inspect_publishers() {
    void* samples[32] = {};
    dds_sample_info_t infos[32];
    const dds_return_t count = dds_take(publications_.get(), samples, infos, 32, 32);
    if (count <= 0) return;
    std::set<std::string> others;
    bool has_publishers = subscription_->has_publishers();
    for (dds_return_t i = 0; i < count; ++i) {
      const auto& writer = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
      if (!infos[i].valid_data || name_ != writer.topic_name) continue;
      if (types_[type_] == writer.type_name) {
        has_publishers = true;
      } else if (writer.participant_instance_handle != own_handle_) {
        others.insert(writer.type_name);
      }
    }
    dds_return_loan(publications_.get(), samples, count);
    const auto is_other = [&](const std::string& type) { return others.count(type) > 0; };
    const auto other = std::find_if(types_.begin(), types_.end(), is_other);
    if (!has_publishers && other != types_.end()) {
      subscribe(static_cast<std::size_t>(other - types_.begin()));
      others.erase(*other);
    }
    constexpr std::size_t most = 20;
    for (const std::string& type : others)
      if (mismatched_types_.size() < most && mismatched_types_.insert(type).second)
        pending_warnings_.push_back("published as " + ros_type(type) + ": publisher ignored, expected " +
                                    ros_type(types_[type_]) +
                                    (mismatched_types_.size() < most ? "" : "; further types are not named"));
  }

  // Reports publishers with incompatible QoS, at most once a second.
  void report_refused_publishers(std::vector<std::string>& all) {
    if (Clock::now() < next_check_) return;
    next_check_ = Clock::now() + std::chrono::seconds(1);
    dds_requested_incompatible_qos_status_t refused{};
    dds_get_requested_incompatible_qos_status(subscription_->reader.get(), &refused);
    if (refused.total_count_change > 0)
      all.push_back(std::to_string(refused.total_count_change) + " publishers with incompatible QoS");
  }

  std::vector<std::string> types_;
  std::string name_;
  Delivery delivery_;
  std::shared_ptr<Participant> participant_;
  Entity publications_, publisher_condition_, waitset_;
  std::optional<Subscription> subscription_;  // of types_[type_]
  std::size_t type_ = 0;
  dds_instance_handle_t own_handle_ = 0;
  std::vector<std::string> pending_warnings_;
  std::set<std::string> mismatched_types_;
  Clock::time_point next_check_{};
};

}  // namespace

std::unique_ptr<MessageReceiver> make_receiver(const std::string& topic,
                                               const std::vector<std::string>& types, Delivery delivery) {
  return std::make_unique<Receiver>(topic, types, delivery);
}

}  // namespace pcl_bv::dds
